#include "firmware/boards/linux/apps/run_modes.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/boards/linux/apps/composition.hpp"
#include "firmware/boards/linux/apps/flight.hpp"
#include "firmware/boards/linux/apps/fly_or_come_up.hpp"
#include "firmware/boards/linux/apps/vehicle_trust.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/clock/host_mission_clock.hpp"
#include "firmware/boards/linux/memory_proof.hpp"
#include "firmware/boards/linux/open_ports.hpp"
#include "firmware/boards/linux/outage/outage_time.hpp"
#include "firmware/boards/linux/outage/safety_places.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/memory/process_memory.hpp"
#include "firmware/host/mission/ports/lock_buses.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/standard_streams.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/host/transport/bus_lock.hpp"

namespace earshot::board {
namespace {

/// With a board that decides: a vehicle must not be left with its last set-point.
constexpr std::chrono::seconds kBoardPatience{3};

/// @throws host::BadInput unless it is past
std::optional<Time> rehearsal_began(const Options& o, Time utc) {
  if (!o.speed_since) return std::nullopt;
  const Time began = Time{} + Duration{static_cast<std::int64_t>(*o.speed_since * 1e6)};
  if (began > utc) throw host::BadInput("--speed-since: must be past; now it is " + std::to_string(utc.us / 1'000'000));
  return began;
}

/// The record of a flight that was not stopped in order; null: nothing goes on.
const host::SafetyRecord* open_record(const Options& o, const host::SafetyCopies& safety) {
  const bool is_open = o.resume && safety.found() && !safety.found()->is_closed;
  return is_open ? &*safety.found() : nullptr;
}

/// The mission clock at sea. Of a mission that goes on it goes by the record; no wall clock that was set meanwhile, either way, is asked.
/// @param record  of the mission that goes on; null: a new one begins
std::unique_ptr<Clock> clock_at_sea(const Options& o, const host::SafetyRecord* record, const HostClock& host, const Outage& outage) {
  auto clock = std::make_unique<HostMissionClock>(host, o.speed, rehearsal_began(o, host.utc()));
  if (record != nullptr && !o.speed_since) clock->go_on_since(record->mission_time, outage.passed);
  return clock;
}

std::vector<host::BusLock> lock_buses(const host::MissionFile& file) {
  std::vector<host::BusLock> locks =
      host::lock_buses_at_sea(file, SafetyFolders::of_this_process().runtime.value_or(std::filesystem::path()));
  for (const host::BusLock& lock : locks) {
    if (!lock.stranger().empty())
      std::cerr << "earshotd: warning: " << host::printable(lock.stranger()) << ", and is no user of this vehicle: not heeded\n";
  }
  return locks;
}

FlightTerms terms_of(const host::MissionFile& file) {
  return {.when_journal_is_full = host::JournalOptions::WhenFull::kDrop,
          .journal_survives = host::JournalOptions::Survives::kPowerCut,
          .existing_journal = host::ExistingJournal::kKeep,
          .write_ahead_patience = std::chrono::milliseconds(100),
          .turns = file.turns,
          .waits_for_others = true,
          .settles_memory = true};
}

int fly(const Options& o, const HostClock& host, host::SafetyCopies& safety) {
  host::MissionVerifier verifier = verifier_at_sea(o.vehicle, host::Counting::kRecorded);
  const host::MissionFile file = load_mission_for_sea(o, verifier);
  const host::SignedSearch search = verifier.load_search(file);
  std::unique_ptr<runtime::Runtime> runtime = make_runtime(file, search, o.mission.string());
  std::unique_ptr<BoardCore> board = make_board(o, file, search, kBoardPatience);
  const std::vector<host::BusLock> locks = lock_buses(file);
  PortSet ports;
  open_ports(file, host, host::IfMissing::kKeepTrying, WakesFor::kMeasurements, ports);  // a link may come after the vehicle computer
  settle(ports);
  const host::SafetyRecord* const record = open_record(o, safety);
  const Outage outage = record != nullptr ? outage_since(*record, host) : Outage{};
  const std::unique_ptr<Clock> clock = clock_at_sea(o, record, host, outage);
  // A vehicle in mid-search must not be left alone with its last set-point because somebody's terminal closed or a key slipped.
  program::ignore_unmeant_signals();
  program::install_sighup_handler();
  program::stop_on_signals();  // up to here nothing is under way that would have to end in order
  if (const std::optional<int> status = wait_for_clock(o, {}, *clock); status) return *status;
  verifier.record_flight();
  Flight flight{.options = o,
                .terms = terms_of(file),
                .file = file,
                .search = search,
                .runtime = std::move(runtime),
                .board = std::move(board),
                .ports = ports,
                .clock = *clock,
                .host = host,
                .manager = service_manager(),
                .safety = &safety,
                .record = record,
                .outage = outage};
  return fly(flight);
}

}  // namespace

int fly_at_sea(const Options& o) {
  const HostClock host;
  host::set_thread_stack(kThreadStackBytes);
  return fly_or_come_up(o, host, [&](host::SafetyCopies& safety) {
    require_possible(o);  // options that do not go together are no reason either to leave a vehicle alone
    return fly(o, host, safety);
  });
}

}  // namespace earshot::board
