#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::wire {

/// Why the program that wrote a journal ended.
enum class Ending : std::uint8_t {
  kMissionOver = 0,  ///< DONE or ABORT, and nobody waited for another turn
  kStopped = 1,      ///< by a signal
  kClockLost = 2,    ///< who drove the clock was gone: a simulator
};

/// The last record of a journal that was ended in order (journal_end_t): without it the program was killed, or lost its power.
struct ClosingRecord {
  Time time;  ///< of the last turn
  Ending ending = Ending::kStopped;
  messages::MissionState state = messages::MissionState::kStandby;
  messages::EndReason end_reason = messages::EndReason::kNone;
  std::uint32_t steps_taken = 0;
  /// Records that the disk did not take.
  struct Lost {
    std::uint64_t streams = 0;
    std::uint64_t steering = 0;
    std::uint64_t orders = 0;

    [[nodiscard]] std::uint64_t all() const { return streams + steering + orders; }
    friend bool operator==(const Lost&, const Lost&) = default;
  } lost = {};

  friend bool operator==(const ClosingRecord&, const ClosingRecord&) = default;
};

inline constexpr std::size_t kClosingRecordBytes = 47;  ///< encoded: fingerprint 8, date 8, three of 1, steps 4, three counts of 8

[[nodiscard]] Encoded encoded(const ClosingRecord& record);

/// kMalformed: the bytes are no journal_end_t. kOutOfRange: they name an ending, a state or a reason that there is not, or a count
/// below zero.
[[nodiscard]] Status read_closing_record(std::span<const std::uint8_t> data, ClosingRecord& record);

}  // namespace earshot::wire
