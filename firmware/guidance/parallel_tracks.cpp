#include "firmware/guidance/parallel_tracks.hpp"

namespace earshot::guidance {
namespace {

/// x rounded up, at least 1 and at most kMostTracks.
std::uint16_t rounded_up(double x) {
  if (!(x > 1.0)) return 1;
  if (x >= static_cast<double>(ParallelTracks::kMostTracks)) return ParallelTracks::kMostTracks;
  const auto below = static_cast<std::uint16_t>(x);
  return static_cast<std::uint16_t>(static_cast<double>(below) < x ? below + 1 : below);
}

}  // namespace

ParallelTracks::ParallelTracks(const TrackPlan& plan, NorthEast start) : plan_(plan) {
  const bool along_north = plan.tracks == Tracks::kNorthSouth;
  const NorthEast size = plan.area.north_east - plan.area.south_west;
  const NorthEast from = start - plan.area.south_west;
  const Meters across = along_north ? size.east : size.north;
  const Meters along = along_north ? size.north : size.east;
  const std::uint16_t gaps = rounded_up(across / plan.spacing);
  apart_ = across / static_cast<double>(gaps);
  if (plan.outer == OuterTracks::kHalfASpacingIn) {
    count_ = gaps;
    first_ = 0.5;
  } else {
    count_ = static_cast<std::uint16_t>(gaps + 1);
  }
  starts_at_far_side_ = (along_north ? from.east : from.north) > 0.5 * across;
  starts_at_far_end_ = (along_north ? from.north : from.east) > 0.5 * along;
}

/// Counted from the side where it begins.
std::size_t ParallelTracks::track_in_turn(std::size_t turn) const {
  std::size_t before = 0;  // tracks of the passes before
  for (std::size_t pass = 0; pass < plan_.passes && pass < count_; ++pass) {
    const std::size_t of_pass = (count_ - pass + plan_.passes - 1) / plan_.passes;
    if (turn < before + of_pass) {
      const std::size_t in_pass = turn - before;
      return pass + plan_.passes * (pass % 2 == 0 ? in_pass : of_pass - 1 - in_pass);
    }
    before += of_pass;
  }
  return count_ - std::size_t{1};
}

NorthEast ParallelTracks::corner(std::size_t index) const {
  const std::size_t track = track_in_turn(index / 2);
  const bool is_far_end = starts_at_far_end_ == ((index + 1) / 2 % 2 == 0);  // the ends of two tracks beside each other follow in turn
  const Meters across = (static_cast<double>(starts_at_far_side_ ? count_ - 1 - track : track) + first_) * apart_;
  const NorthEast size = plan_.area.north_east - plan_.area.south_west;
  if (plan_.tracks == Tracks::kNorthSouth) return plan_.area.south_west + NorthEast{is_far_end ? size.north : Meters{0.0}, across};
  return plan_.area.south_west + NorthEast{across, is_far_end ? size.east : Meters{0.0}};
}

}  // namespace earshot::guidance
