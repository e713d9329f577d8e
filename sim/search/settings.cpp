#include "sim/search/settings.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

namespace earshot::search {
namespace {

bool is_rectangle(const Rectangle& r) {
  return is_finite(r.south_west) && is_finite(r.north_east) && r.south_west.north < r.north_east.north &&
         r.south_west.east < r.north_east.east;
}

/// The region's corner furthest from the source is as far as any start can be.
bool can_start_out_of_reach(const SearchSettings& s) {
  const Meters north = std::max(s.start_region.north_east.north - s.source.north, s.source.north - s.start_region.south_west.north);
  const Meters east = std::max(s.start_region.north_east.east - s.source.east, s.source.east - s.start_region.south_west.east);
  return length_of({north, east}) > s.step_length;
}

/// The source may be as far from a start as the two furthest corners of domain and start region are from each other.
bool has_room_for_a_search(const SearchSettings& s) {
  const Rectangle& r = s.start_region;
  const Meters north = std::max(r.north_east.north - s.domain.south_west.north, s.domain.north_east.north - r.south_west.north);
  const Meters east = std::max(r.north_east.east - s.domain.south_west.east, s.domain.north_east.east - r.south_west.east);
  return length_of({north, east}) > s.step_length;
}

bool positive(double x) {
  return is_finite(x) && x > 0.0;
}

}  // namespace

Rectangle inside_border(const SearchSettings& s) {
  return s.domain.moved_in(s.border_width);
}

Meters furthest_range(const SearchSettings& s) {
  return range_between(s.domain.south_west, s.domain.north_east) + s.step_length;
}

std::size_t measurements_on_leg(config::ListeningWindow window, double leg_s) {
  const double reach_s = std::min(window.length.to_seconds(), leg_s);
  return std::max<std::size_t>(1, static_cast<std::size_t>(reach_s / kMeasurementInterval.to_seconds()));
}

Status check(const SearchSettings& s) {
  const bool sizes =
      s.direction_count >= 1 && s.direction_count <= config::kMaxActions && s.max_steps >= 1 && config::is_valid(s.listening);
  const bool lengths = positive(s.step_length.value) && positive(s.border_width.value);
  const bool levels = is_finite(s.detection_threshold.value) && is_finite(s.border_reward);
  if (!sizes || !lengths || !levels || !is_rectangle(s.domain) || !is_rectangle(s.start_region)) return Status::kOutOfRange;
  if (!s.domain.contains(s.start_region.south_west) || !s.domain.contains(s.start_region.north_east)) return Status::kOutOfRange;
  if (s.placement == SourcePlacement::kChanging) return has_room_for_a_search(s) ? Status::kOk : Status::kOutOfRange;
  if (!is_finite(s.source) || !can_start_out_of_reach(s)) return Status::kOutOfRange;
  return Status::kOk;
}

NorthEast uniform_in(const Rectangle& area, Pcg32& random) {
  const double north = random.uniform_double();
  const double east = random.uniform_double();
  return {area.south_west.north + north * (area.north_east.north - area.south_west.north),
          area.south_west.east + east * (area.north_east.east - area.south_west.east)};
}

}  // namespace earshot::search
