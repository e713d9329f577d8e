#include "firmware/boards/linux/apps/run_modes.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/boards/linux/apps/composition.hpp"
#include "firmware/boards/linux/apps/flight.hpp"
#include "firmware/boards/linux/apps/vehicle_trust.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/open_ports.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/boards/linux/service/service_manager.hpp"
#include "firmware/boards/linux/simulation_plugin.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "firmware/host/mission/ports/lock_buses.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/transport/bus_lock.hpp"

namespace earshot::board {
namespace {

/// With a board that decides: it may be an emulator on a busy machine.
constexpr std::chrono::seconds kBoardPatience{60};

host::MissionFile load(const Options& o, host::MissionVerifier& verifier) {
  host::MissionFile file = load_mission(o, verifier);
  if (!o.snr_from_bus) host::leave_snr_to_simulator(file);
  if (o.hear) {
    host::require_hydrophone(file, o.mission);
  } else {
    host::leave_out_hydrophones(file);
  }
  return file;
}

/// The simulator waits for whatever this program waits for.
FlightTerms terms_of(const Options& o) {
  return {.when_journal_is_full = host::JournalOptions::WhenFull::kWait,
          .journal_survives = host::JournalOptions::Survives::kProcess,
          .existing_journal = o.resume ? host::ExistingJournal::kKeep : host::ExistingJournal::kRefuse,
          .write_ahead_patience = std::chrono::seconds(60),
          .turns = host::Turns::kPeriodic,
          .waits_for_others = false,
          .settles_memory = false};
}

}  // namespace

int fly_in_simulation(const Options& o) {
  const HostClock host;
  host::MissionVerifier verifier = verifier_in_simulation(o.vehicle);
  const host::MissionFile file = load(o, verifier);
  const host::SignedSearch search = verifier.load_search(file);
  std::unique_ptr<runtime::Runtime> runtime = make_runtime(file, search, o.mission.string());
  std::unique_ptr<BoardCore> board = make_board(o, file, search, kBoardPatience);
  const std::vector<host::BusLock> locks = host::lock_buses(file, host::BusPlace::kVehicle);
  PortSet ports;
  open_ports(file, host, host::IfMissing::kRefuse, WakesFor::kBlocks, ports);
  settle(ports);
  Simulation simulation = open_simulation({.domain = *o.simulation, .run = o.run, .port = ports.next_index()});
  ports.add(std::move(simulation.port));
  program::stop_on_signals();  // up to here nothing is under way that would have to end in order
  // The journal of an earlier flight is not touched before a simulator has come, and that comes when it has judged its own input.
  const std::string whose = "a simulator in DDS domain " + std::to_string(*o.simulation);
  if (const std::optional<int> status = wait_for_clock(o, whose, *simulation.clock); status) return *status;
  verifier.record_flight();
  Flight flight{.options = o,
                .terms = terms_of(o),
                .file = file,
                .search = search,
                .runtime = std::move(runtime),
                .board = std::move(board),
                .ports = ports,
                .clock = *simulation.clock,
                .host = host,
                .manager = ServiceManager(ServiceEnvironment{})};  // a simulation is nobody's service
  return fly(flight);
}

}  // namespace earshot::board
