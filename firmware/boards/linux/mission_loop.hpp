#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/outage/meanwhile.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/journal_records.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// Set-points that tell the vehicle to stop and come up, sent before a program ends: on a bus that loses messages one may not arrive.
inline constexpr int kLastSetpoints = 5;

/// Why the loop returned.
enum class LoopEnd : std::uint8_t {
  kMissionOver,  ///< DONE or ABORT, and nobody waits for another turn
  kStopped,      ///< a person asked for it (SIGINT, SIGTERM)
  kClockLost,    ///< who drives the clock is gone (a simulator)
  kOvertaken,    ///< another process commands the vehicle, because this one hung
};

struct LoopResult {
  LoopEnd end = LoopEnd::kStopped;
  runtime::Outputs last;  ///< of the last turn, which may be one of the process that a resumed mission had before
  Time began;             ///< when the loop began
  Time time;              ///< of the last turn
  std::uint64_t turns = 0;
  std::array<std::uint64_t, messages::kMissionStates> turns_in{};      ///< of these, those after which the mission was in each state
  messages::MissionState found_in = messages::MissionState::kStandby;  ///< the state of the last turn before it was told to stop
};

/// What makes the turns of a loop at sea; in lock-step its clock does.
struct Pace {
  Duration period;  ///< between two turns, at most
  host::Turns turns = host::Turns::kPeriodic;
};

/// The wait of a mission that goes on from its journal for its sensors, so that its first turn does not end it for the silence of its own
/// outage.
struct Hold {
  Duration most;                   ///< for so long its first turn waits for navigation and SNR; less when an ABORT or a leak is told
  Meanwhile* meanwhile = nullptr;  ///< who commands the vehicle until then, once a period; null: nobody does
  Time meanwhile_from = Time{};    ///< and from when
};

/// The record that ends the journal of a flight that ended so.
[[nodiscard]] messages::ClosingRecord closing_record_of(const LoopResult& result);

/// The one loop of a mission, at sea and in simulation: takes what the ports bring as it comes, makes a turn when the clock says so, tries
/// to open again what is down. Missed turns are not made up for.
/// When it is told to stop and the mission is not over, it makes an ABORT, so that the autopilot does not go on with the last set-point,
/// and then turns, the first at once, until the set-point that says so was sent five times (a bus may lose one), or as long as somebody
/// waits for turns.
/// Where arrivals make turns, a fix or an order that has been taken is answered by a turn at once, but no sooner than kLeastBetweenTurns_us
/// after the last: a flood waits for the next turn. Silence makes a turn a period after the last.
/// @param stop    set by a signal handler
/// @param hold    of a mission that goes on from its journal
[[nodiscard]] LoopResult fly(MissionTurn& turn, PortSet& ports, Clock& clock, const Pace& pace, const std::atomic<bool>& stop,
                             const Hold& hold = {});

}  // namespace earshot::board
