#pragma once

#include "firmware/config/mission.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::support {

/// A mission that the policy was trained for, its area at the origin. Where the area is too small for the policy's step, config::check
/// refuses it.
[[nodiscard]] inline config::Mission mission_for(const policy::FrozenPolicy& policy) {
  config::Mission mission;
  mission.operating_area = {.south_west = {}, .north_east = policy.area_size};
  mission.search_depth = Meters{300.0};
  mission.max_depth = Meters{320.0};
  mission.search_speed = MetersPerSecond{2.0};
  mission.step_length = policy.step_length;
  mission.max_time = Duration::seconds(1'000'000);
  mission.navigation_timeout = Duration::seconds(5);
  mission.snr_timeout = Duration::seconds(5);
  mission.detection_threshold = policy.detection_threshold;
  mission.listening = policy.observation.listening;
  return mission;
}

}  // namespace earshot::support
