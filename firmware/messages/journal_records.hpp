#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::messages {

// What stands in journals only, besides what goes in and out of a runtime.

/// Version and commit of a program, zeros behind it.
using Build = std::array<std::uint8_t, 64>;
/// Lives as long as the build.
[[nodiscard]] inline std::string_view text_of(const Build& build) {
  const auto end = std::find(build.begin(), build.end(), std::uint8_t{0});
  return {reinterpret_cast<const char*>(build.data()), static_cast<std::size_t>(end - build.begin())};  // NOLINT: characters are bytes
}

/// What is flown: the first record of a journal.
struct MissionRecord {
  config::Mission mission;
  std::uint32_t policy_crc32 = 0;  ///< of the whole .policy file
  std::uint32_t tables_crc32 = 0;  ///< of the whole .tables file; 0: none
  Build build{};
  friend constexpr bool operator==(const MissionRecord&, const MissionRecord&) = default;
};

/// A later part of a journal begins with it.
struct JournalPart {
  std::uint32_t part = 0;                ///< counted from 1: the second file has 2
  std::uint32_t first_record_crc32 = 0;  ///< of the journal's first record, as it stands there: which journal this is a part of
  friend constexpr bool operator==(const JournalPart&, const JournalPart&) = default;
};

/// Where another process went on with a mission from its journal.
struct JournalResumed {
  Time time;
  std::uint64_t cut_bytes = 0;  ///< behind what stands before: of a record that was never whole, or of a turn that is made again
  Build build{};                ///< of the program that goes on
  friend constexpr bool operator==(const JournalResumed&, const JournalResumed&) = default;
};

enum class ControllerState : std::uint8_t {
  kErrorPassive = 0,  ///< it counts many errors
  kBusOff = 1,        ///< it has left the bus
};

/// The CAN controller of a port is in trouble from now on, or no longer: its kernel reported it. It steers nothing.
struct ControllerTrouble {
  Time time;
  std::uint8_t port = 0;
  ControllerState trouble = ControllerState::kErrorPassive;
  bool is_there = false;  ///< false: it is over
  friend constexpr bool operator==(const ControllerTrouble&, const ControllerTrouble&) = default;
};

/// Why the program that wrote a journal ended.
enum class Ending : std::uint8_t {
  kMissionOver = 0,  ///< DONE or ABORT, and nobody waited for another turn
  kStopped = 1,      ///< by a signal
  kClockLost = 2,    ///< who drove the clock was gone: a simulator
};

/// Records that the disk did not take.
struct LostRecords {
  std::uint64_t streams = 0;   ///< navigation, SNR, reports, health
  std::uint64_t steering = 0;  ///< set-points and decisions
  std::uint64_t orders = 0;    ///< mission, policy, commands, acknowledgements, changes of state

  [[nodiscard]] constexpr std::uint64_t all() const { return streams + steering + orders; }
  friend constexpr bool operator==(const LostRecords&, const LostRecords&) = default;
};

/// The last record of a journal that was ended in order: without it the program was killed, or lost its power.
struct ClosingRecord {
  Time time;  ///< of the last turn
  Ending ending = Ending::kStopped;
  MissionState state = MissionState::kStandby;
  EndReason end_reason = EndReason::kNone;
  std::uint32_t steps_taken = 0;
  LostRecords lost = {};
  friend constexpr bool operator==(const ClosingRecord&, const ClosingRecord&) = default;
};

}  // namespace earshot::messages
