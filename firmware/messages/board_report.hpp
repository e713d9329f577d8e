#pragma once

#include <cstdint>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"

namespace earshot::messages {

enum class BoardEvent : std::uint8_t {
  kStarted = 0,     ///< and knows of no mission; the first thing that it sends
  kArmed = 1,       ///< it has a mission, a policy and ocean tables
  kRefused = 2,     ///< what it was sent; `status` has the reason
  kInputsLost = 3,  ///< fewer inputs have come than the turn counts
  kDecided = 4,     ///< in the turn before
};

/// How a microcontroller that flies a mission is doing.
struct BoardReport {
  Time time;
  BoardEvent event = BoardEvent::kStarted;
  Status status = Status::kOk;
  std::uint32_t frames_refused = 0;  ///< torn on the line
  std::uint32_t bytes_lost = 0;      ///< that arrived when there was no room
  std::uint32_t turn_us = 0;         ///< that the last turn took, by the board's clock
  std::uint32_t stack_bytes = 0;
  std::uint32_t stack_used_bytes = 0;  ///< at most, since the start
  friend constexpr bool operator==(const BoardReport&, const BoardReport&) = default;
};

}  // namespace earshot::messages
