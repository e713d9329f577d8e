#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/safety_event.hpp"
#include "tests/hil/seconds.hpp"

namespace earshot::hil {

using Words = std::vector<std::string>;

/// A square of 10 km, 2 m/s, 300 m deep and no deeper than 320 m.
inline config::Mission mission() {
  config::Mission mission;
  mission.operating_area = {.south_west = {}, .north_east = {Meters{10'000}, Meters{10'000}}};
  mission.search_depth = Meters{300};
  mission.max_depth = Meters{320};
  mission.search_speed = MetersPerSecond{2};
  return mission;
}

inline messages::SafetyEvent event(std::int64_t s, config::Condition condition, bool begins = true) {
  return {.time = at_s(s), .condition = condition, .begins = begins};
}

}  // namespace earshot::hil
