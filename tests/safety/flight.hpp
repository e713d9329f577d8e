#pragma once

#include <cstdint>
#include <string>

#include "firmware/messages/health.hpp"
#include "tests/safety/drawn_mission.hpp"

namespace earshot::campaign {

struct FlightResult {
  messages::MissionState state = messages::MissionState::kStandby;
  messages::EndReason end_reason = messages::EndReason::kNone;
  std::uint32_t steps = 0;
  std::int64_t seconds = 0;
  bool was_steered_back = false;
  std::string broken;  ///< what was promised and not kept; empty: nothing
};

/// Flies a drawn mission to its end, turn by turn, and holds it against what is promised:
/// no set-point outside its limits; the true vehicle not beyond the halt polygon nor below the depth limit, as long as it moves as its
/// mission says; an abort in time where there must be one, and none where there must not.
[[nodiscard]] FlightResult fly(const DrawnMission& drawn);

}  // namespace earshot::campaign
