#include "firmware/guidance/sweep.hpp"

#include "firmware/guidance/leg.hpp"

namespace earshot::guidance {
namespace {

constexpr double kReached = 0.5;  ///< step lengths from a corner
constexpr double kSpacing = 2.0;  ///< step lengths between tracks
/// Of 25 km x 25 km, in steps of 1 km to eight directions, 100 steps come within a step length of 26.8 % in one pass, of 29.4 in two, 29.8
/// in three, 30.0 in four, for the way to the corner is swept twice in the first pass; 200 steps of 54, 59, 58 and 56 %.
constexpr std::uint16_t kPasses = 3;
constexpr std::uint16_t kMostAtOnce = 4;  ///< corners that count as reached from one place: all of an area no larger than a step

/// The area without its margin; where that leaves nothing, its middle line or point.
Rectangle without_margin(const Rectangle& area, Meters margin) {
  Rectangle inside = area.moved_in(margin);
  const auto meet = [](Meters& low, Meters& high) {
    if (low > high) low = high = 0.5 * (low + high);
  };
  meet(inside.south_west.north, inside.north_east.north);
  meet(inside.south_west.east, inside.north_east.east);
  return inside;
}

}  // namespace

Sweep::Sweep(const SweepPlan& plan, NorthEast position)
    : inside_(without_margin(plan.area, plan.margin)), step_length_(plan.step_length), from_(position) {
  const NorthEast size = inside_.north_east - inside_.south_west;
  direction_ = size.east > size.north ? Tracks::kEastWest : Tracks::kNorthSouth;
  tracks_ = ParallelTracks({.area = inside_, .spacing = kSpacing * step_length_, .tracks = direction_, .passes = kPasses}, position);
}

SweepStep Sweep::next(NorthEast position, std::span<const UnitNorthEast> actions) {
  for (std::uint16_t i = 0; i < kMostAtOnce && is_reached(position, actions); ++i) turn(position);
  const NorthEast waypoint = waypoint_from(position);
  return {.waypoint = waypoint, .action = action_toward(waypoint, position, actions)};
}

/// Makes for the next corner, along the track from the one that is reached.
void Sweep::turn(NorthEast position) {
  from_ = corner();
  ++next_;
  ++corners_reached_;
  if (next_ < tracks_.corner_count()) return;
  direction_ = direction_ == Tracks::kNorthSouth ? Tracks::kEastWest : Tracks::kNorthSouth;
  tracks_ = ParallelTracks({.area = inside_, .spacing = kSpacing * step_length_, .tracks = direction_, .passes = kPasses}, position);
  next_ = 0;
}

bool Sweep::is_reached(NorthEast position, std::span<const UnitNorthEast> actions) const {
  const Meters range = range_between(position, corner());
  if (range <= kReached * step_length_) return true;
  const NorthEast end = position + step_length_ * actions[action_toward(corner(), position, actions)];
  return !(range_between(end, corner()) < range);
}

std::size_t Sweep::action_toward(NorthEast place, NorthEast position, std::span<const UnitNorthEast> actions) const {
  std::size_t best = 0;
  Meters least{};
  bool is_best_inside = false;
  for (std::size_t action = 0; action < actions.size(); ++action) {
    const NorthEast end = position + step_length_ * actions[action];
    const bool is_inside = inside_.contains(end);
    const Meters off = range_between(end, place);
    const bool is_better = is_inside == is_best_inside ? off < least : is_inside;
    if (action > 0 && !is_better) continue;
    best = action;
    least = off;
    is_best_inside = is_inside;
  }
  return best;
}

NorthEast Sweep::waypoint_from(NorthEast position) const {
  const Leg leg(from_, corner());
  const Meters made_good = leg.along_track(position);
  const Meters ahead = (made_good > Meters{0.0} ? made_good : Meters{0.0}) + step_length_;
  if (!(ahead < leg.length())) return corner();
  const double share = ahead / leg.length();
  const NorthEast way = corner() - from_;
  return from_ + NorthEast{share * way.north, share * way.east};
}

}  // namespace earshot::guidance
