#pragma once

#include <cstdint>

#include "firmware/host/safety_record/safety_record.hpp"

namespace earshot::host {

/// Every field of it is another number.
inline SafetyRecord some_record(std::uint64_t sequence) {
  return {.sequence = sequence,
          .boot = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16},
          .since_boot = Duration::seconds(17),
          .utc = {1'795'000'000'000'018},
          .mission_time = {1'795'000'000'000'019},
          .journal_crc32 = 20,
          .kept_crc32 = 21,
          .starts = 22,
          .turn = 23,
          .state = messages::MissionState::kAbort,
          .end_reason = messages::EndReason::kSafetyRule,
          .is_engaged = true,
          .is_paused = false,
          .is_released = true,
          .is_closed = false,
          .max_depth = Meters{24},
          .max_speed = MetersPerSecond{2.5},
          .max_time = Duration::seconds(26),
          .deepest = Meters{27},
          .ascent_speed = MetersPerSecond{0.28},
          .turn_radius = Meters{29},
          .owner = {.computer = 30, .folder = 31}};
}

}  // namespace earshot::host
