#include "firmware/config/mission.hpp"

#include <algorithm>
#include <array>

#include "firmware/core/math.hpp"

namespace earshot::config {
namespace {

template <std::size_t N>
bool all_finite(const std::array<double, N>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return is_finite(value); });
}

bool is_finite_mission(const Mission& mission) {
  const Rectangle& area = mission.operating_area;
  return all_finite(std::array{area.south_west.north.value, area.south_west.east.value, area.north_east.north.value,
                               area.north_east.east.value, mission.edge_margin.value, mission.search_depth.value, mission.max_depth.value,
                               mission.search_speed.value, mission.step_length.value, mission.detection_threshold.value,
                               mission.source_frequency.value});
}

bool leaves_room_to_search(const Mission& mission) {
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  const Meters needed = 2.0 * mission.edge_margin + kShortestSideInSteps * mission.step_length;
  return size.north >= needed && size.east >= needed;
}

}  // namespace

Status check(const Mission& mission) {
  constexpr Duration kNone{};
  const bool usable = is_finite_mission(mission) && mission.edge_margin.value >= 0.0 && mission.search_depth.value > 0.0 &&
                      mission.max_depth >= mission.search_depth && mission.search_speed.value > 0.0 && mission.step_length.value > 0.0 &&
                      mission.max_steps >= 1 && mission.max_time > kNone && mission.navigation_timeout > kNone &&
                      mission.snr_timeout > kNone && mission.source_frequency.value > 0.0 && is_valid(mission.listening) &&
                      leaves_room_to_search(mission);
  return usable ? Status::kOk : Status::kOutOfRange;
}

}  // namespace earshot::config
