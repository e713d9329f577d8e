#pragma once

#include <chrono>
#include <memory>

#include "firmware/boards/linux/apps/earshotd_options.hpp"
#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/core/board_core.hpp"
#include "firmware/boards/linux/outage/outage_time.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/boards/linux/service/service_manager.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/mission/tables_file.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// What differs between flights at sea and in simulation.
struct FlightTerms {
  host::JournalOptions::WhenFull when_journal_is_full;
  host::JournalOptions::Survives journal_survives;  ///< unless an option says
  host::ExistingJournal existing_journal;           ///< unless an option has it replaced
  std::chrono::milliseconds write_ahead_patience;   ///< with a slow disk
  host::Turns turns;
  bool waits_for_others;  ///< for sensors and an operator, as long as it takes; a simulator has them at hand
  bool settles_memory;    ///< none is asked for in flight; a simulator's middleware does as it likes with it
};

/// What the mission is flown with.
struct Flight {
  const Options& options;
  FlightTerms terms;
  const host::MissionFile& file;
  const host::SignedSearch& search;
  std::unique_ptr<runtime::Runtime> runtime;
  std::unique_ptr<BoardCore> board;  ///< that decides in its place; none: nobody does
  PortSet& ports;
  Clock& clock;
  const HostClock& host;
  ServiceManager manager;
  host::SafetyCopies* safety = nullptr;        ///< of a vehicle at sea
  const host::SafetyRecord* record = nullptr;  ///< of a flight that was not stopped in order, as it was found; null: nothing goes on
  Outage outage = {};                          ///< since that was written
  bool holds_orders = false;                   ///< what that record says is to hold in the mission that is flown
};

/// Said when a program was stopped and the record could not be closed.
inline constexpr const char* kStaysUnderWay =
    "earshotd: the vehicle was not at the surface yet by depth and time: it stays under way, and the next start with --resume brings it "
    "up\n";

/// Takes all memory that the flight needs, and says what that cost where it is worth a line.
void report_settled_memory();

/// Of a vehicle at sea.
[[nodiscard]] ServiceManager service_manager();

/// Begins the mission, or goes on with it, and flies it to its end.
/// @return exit status
/// @throws host::BadInput before the first turn, when it cannot
[[nodiscard]] int fly(Flight& f);

}  // namespace earshot::board
