#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/safety_event.hpp"
#include "hil/bench/bench_flight.hpp"
#include "hil/bench/case.hpp"

namespace earshot::hil {

inline constexpr Meters kAtSurface{1.0};  ///< a vehicle of a few metres shows its antenna

/// That a CAN controller is in trouble, or no longer.
struct ControllerTrouble {
  bool is_bus_off = false;  ///< else error-passive
  bool begins = false;
};

/// What the journal of a flight says.
struct JournalFindings {
  std::string trouble;  ///< why it cannot be read; empty: it can
  std::vector<messages::SafetyEvent> events;
  std::vector<Time> decisions;
  messages::EndReason end = messages::EndReason::kNone;
  messages::Counters counters;  ///< refusals alone
  std::uint64_t setpoints = 0;
  std::vector<ControllerTrouble> troubles;
  std::array<std::uint64_t, config::kMaxPorts>
      lost{};                              ///< of each port: messages that arrived faster than it read them, and samples of a hydrophone's
  std::vector<std::string> beyond_limits;  ///< set-points that no mission may give, in words
  bool is_same_again = false;              ///< given to the runtime again, it gives every output again
  std::string difference;                  ///< in words, where it does not
};

/// @param journal  of a flight of `mission`
/// @param began    what it dates the flight's time 0
[[nodiscard]] JournalFindings read_findings(const std::filesystem::path& journal, const config::Mission& mission, Time began = {});

// What is wrong with a flight, in words; nothing: all is as it had to be. Judged by the journal, the true track and exit statuses, never by
// what was printed.

/// Of every flight, whatever its case: it is flown to its end, earshotd ends in order and by no signal that nobody sent, no set-point is
/// beyond the mission's limits, no true place is beyond the halt polygon or 25 m below the depth limit, and the journal gives every output
/// again. A vehicle that does not do as it is told, or is told wrongly where it is, may leave the polygon (is_beyond_command).
[[nodiscard]] std::vector<std::string> broken_promises(const Case& c, const config::Mission& mission, const BenchFlight& flight,
                                                       const JournalFindings& journal);

/// Of the case.
[[nodiscard]] std::vector<std::string> unmet_expectations(const Case& c, const BenchFlight& flight, const JournalFindings& journal);

/// Whether no software could keep a vehicle with this fault where it belongs.
[[nodiscard]] bool is_beyond_command(const TimedFault& fault, const config::Mission& mission);

}  // namespace earshot::hil
