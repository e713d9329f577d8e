#include "policy/baselines/patterns.hpp"

#include <algorithm>
#include <cmath>

#include "policy/baselines/moves.hpp"

namespace earshot::baselines {
namespace {

constexpr double kReached = 1.25;  ///< step lengths from a corner: steps of whole lengths that keep out of the border may come no nearer

}  // namespace

std::size_t RandomWalk::choose(const DecisionInput& input) {
  FixedVector<std::size_t, config::kMaxActions> free;
  for (std::size_t action = 0; action < prior_.actions.size(); ++action) {
    if (border_cost(prior_.settings, end_of(prior_, input.position, action)) > 0.0) continue;
    [[maybe_unused]] const Status status = free.push_back(action);
  }
  return free.empty() ? random_.next() % prior_.actions.size() : free[random_.next() % free.size()];
}

Meters assured_detection_range(const PriorKnowledge& prior) {
  const std::vector<float>& snr = prior.snr.samples_db();
  const auto threshold = static_cast<float>(prior.settings.detection_threshold.value);
  const auto first_unheard = std::ranges::find_if(snr, [threshold](float x) { return x < threshold; });
  const auto heard = first_unheard - snr.begin();
  return static_cast<double>(std::max<std::ptrdiff_t>(heard - 1, 0)) * prior.snr.range_step();
}

std::vector<NorthEast> lawn_mower_corners(const Rectangle& area, Meters spacing, Tracks tracks, NorthEast start) {
  const NorthEast size = area.north_east - area.south_west;
  const bool along_north = tracks == Tracks::kNorthSouth;
  const Meters across = along_north ? size.east : size.north;
  const Meters along = along_north ? size.north : size.east;
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(across / spacing)));
  const Meters apart = across / static_cast<double>(count);
  const NorthEast from = start - area.south_west;
  const bool far_side = (along_north ? from.east : from.north) > 0.5 * across;
  bool far_end = (along_north ? from.north : from.east) > 0.5 * along;
  std::vector<NorthEast> corners;
  for (std::size_t i = 0; i < count; ++i, far_end = !far_end) {
    const double track = static_cast<double>(far_side ? count - 1 - i : i) + 0.5;
    for (const Meters end : {far_end ? along : Meters{0.0}, far_end ? Meters{0.0} : along}) {
      corners.push_back(area.south_west + (along_north ? NorthEast{end, track * apart} : NorthEast{track * apart, end}));
    }
  }
  return corners;
}

LawnMower::LawnMower(const PriorKnowledge& prior)
    : prior_(prior), spacing_(2.0 * std::max(assured_detection_range(prior), prior.settings.step_length)) {}

void LawnMower::begin(Pcg32 /*random*/) {
  corners_.clear();
  next_ = 0;
  tracks_ = Tracks::kNorthSouth;
}

std::size_t LawnMower::choose(const DecisionInput& input) {
  if (next_ < corners_.size() && range_between(input.position, corners_[next_]) <= kReached * prior_.settings.step_length) ++next_;
  if (next_ >= corners_.size()) {
    if (!corners_.empty()) tracks_ = tracks_ == Tracks::kNorthSouth ? Tracks::kEastWest : Tracks::kNorthSouth;
    corners_ = lawn_mower_corners(search::inside_border(prior_.settings), spacing_, tracks_, input.position);
    next_ = 0;
  }
  return warily_toward(prior_, input.position, corners_[next_]);
}

void ExpandingSquare::begin(Pcg32 /*random*/) {
  leg_ = 0;
  steps_left_ = 2;
}

void ExpandingSquare::turn() {
  ++leg_;
  steps_left_ = 2 * (leg_ / 2 + 1);
}

std::size_t ExpandingSquare::choose(const DecisionInput& input) {
  const std::size_t quarter = std::max<std::size_t>(prior_.actions.size() / 4, 1);
  if (steps_left_ == 0) turn();
  const auto heading = [&] { return leg_ % 4 * quarter % prior_.actions.size(); };
  for (int turns = 0; turns < 4 && border_cost(prior_.settings, end_of(prior_, input.position, heading())) > 0.0; ++turns) turn();
  --steps_left_;
  return heading();
}

}  // namespace earshot::baselines
