// earshotd: the process that flies the vehicle.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/boards/linux/apps/at_sea.hpp"
#include "firmware/boards/linux/apps/earshotd_options.hpp"
#include "firmware/boards/linux/apps/flight.hpp"
#include "firmware/boards/linux/apps/vehicle_trust.hpp"
#include "firmware/boards/linux/core/board_core.hpp"
#include "firmware/boards/linux/core/core.hpp"
#include "firmware/boards/linux/host_clock.hpp"
#include "firmware/boards/linux/host_mission_clock.hpp"
#include "firmware/boards/linux/memory_proof.hpp"
#include "firmware/boards/linux/outage/outage_time.hpp"
#include "firmware/boards/linux/outage/safety_places.hpp"
#include "firmware/boards/linux/port_set.hpp"
#include "firmware/boards/linux/simulation_plugin.hpp"
#include "firmware/boards/linux/waiting.hpp"
#include "firmware/desk/checklist/chart.hpp"
#include "firmware/desk/checklist/checklist.hpp"
#include "firmware/desk/checklist/doubts.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/memory/heap_trap.hpp"
#include "firmware/host/memory/process_memory.hpp"
#include "firmware/host/mission/lock_buses.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_judge.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/standard_streams.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "firmware/host/transport/serial_line.hpp"
#include "firmware/runtime/runtime.hpp"

namespace {

using namespace earshot;

using board::Options;
using program::kLost;

board::Venture venture_of(const Options& o) {
  if (o.simulation) return board::Venture::kSimulation;
  return o.check ? board::Venture::kChecklist : board::Venture::kAtSea;
}

host::MissionFile load(const Options& o, host::MissionJudge& judge) {
  board::require_as_signed(judge,
                           {.policy = o.policy.has_value(),
                            .tables = o.tables.has_value(),
                            .public_key = o.public_key.has_value(),
                            .seed = o.seed.has_value(),
                            .ports = o.ports},
                           venture_of(o));
  host::MissionFile file = judge.load_mission(o.mission);
  if (o.policy) {
    file.policy = *o.policy;
    file.policy_named_at.clear();
  }
  if (o.tables) {
    file.tables = *o.tables;
    file.tables_named_at.clear();
  }
  if (o.public_key) {
    file.public_key = *o.public_key;
    file.public_key_named_at.clear();
  }
  host::require_named_files(file);
  if (o.seed) file.mission.action_seed = *o.seed;
  host::override_ports(file, o.ports);
  if (o.simulation && !o.snr_from_bus) host::leave_snr_to_simulator(file);
  if (o.simulation && o.hear) {
    host::require_hydrophone(file, o.mission);
  } else if (o.simulation) {
    host::leave_out_hydrophones(file);
  } else {
    host::require_ports_for_sea(file, o.mission);
  }
  return file;
}

std::unique_ptr<runtime::Runtime> make_runtime(const host::MissionFile& file, const host::SignedSearch& search,
                                               const std::string& mission_name) {
  host::check_fits(*search.policy.policy, file.policy, file.mission, mission_name);
  auto runtime = std::make_unique<runtime::Runtime>();
  const Status status = runtime->configure(file.mission, *search.policy.policy, *search.tables.tables);
  if (status == Status::kCorrupt) throw host::BadInput(host::to_string({.fault = policy::PolicyFault::kGoldenMismatch}, file.policy));
  if (status != Status::kOk) throw host::BadInput(mission_name + ": cannot be flown with the policy " + file.policy.string());
  return runtime;
}

/// The mission must fit this build, too: its refusals name file and key.
std::unique_ptr<board::BoardCore> make_board(const Options& o, const host::MissionFile& file, const host::SignedSearch& search) {
  if (!o.board) return nullptr;
  // At sea a vehicle must not be left with its last set-point; in simulation the board may be an emulator on a busy machine.
  const std::chrono::seconds patience(o.simulation ? 60 : 3);
  return std::make_unique<board::BoardCore>(host::SerialLine(*o.board), file.mission, search.policy.bytes, search.tables.bytes, patience);
}

/// Makes nothing: of a folder that is not there yet, what would be made first is judged.
/// @throws host::BadInput when a flight could not write its journal.
void require_room_for_journal(const Options& o) {
  std::filesystem::path made = (std::filesystem::absolute(o.out) / "journal.lcmlog").lexically_normal();
  std::error_code error;
  while (!std::filesystem::exists(made.parent_path(), error)) made = made.parent_path();
  // Without --replace a flight leaves a journal that is there, and numbers its own.
  host::require_writable(made, host::kJournalOutput, o.replace ? host::Replace::kOwnKind : host::Replace::kAny,
                         "move it away, or name another folder with --out");
}

/// Who checks a mission need not do so where it will be flown from. @return empty: none
/// @throws host::BadInput as require_room_for_journal() of a folder that is named
std::string doubt_about_journal(const Options& o) {
  try {
    require_room_for_journal(o);
    return {};
  } catch (const host::BadInput& e) {
    if (o.names_out) throw;
    return std::string(e.what()) + "; the flight needs another folder for its journal: --out names it";
  }
}

/// The checklist before a dive.
/// @return exit status
int check(const Options& o) {
  host::MissionJudge judge = board::judge_of(o.vehicle, venture_of(o));
  const host::MissionFile file = load(o, judge);
  const host::SignedSearch search = judge.load_search(file);
  (void)make_runtime(file, search, o.mission.string());
  const std::string about_journal = doubt_about_journal(o);
  if (o.chart) {
    host::require_writable(*o.chart, host::kSvgOutput, host::Replace::kOwnKind, "name another file");
    host::write_whole(*o.chart, board::chart(file.mission, host::printable(o.mission.filename().string())));
  }
  program::say() << board::checklist(file, search, o.mission.string(), board::signatures_of(judge, search));
  if (o.chart) program::say() << "chart         " << host::printable(o.chart->string()) << "\n";
  std::vector<std::string> doubts = board::doubts_about(file);
  if (!about_journal.empty()) doubts.push_back(about_journal);
  // Of a mission that is flown after `--quiet --check` nobody may say that he was not told.
  std::ostream& told = program::talk() == program::Talk::kQuiet ? std::cerr : program::say();
  for (const std::string& doubt : doubts) told << "doubt: " << doubt << "\n";
  program::say() << "ready to dive" << (doubts.empty() ? "" : ", but for what is in doubt") << "\n";
  return program::kDone;
}

/// @throws host::BadInput unless it is past
std::optional<Time> rehearsal_began(const Options& o, Time utc) {
  if (!o.speed_since) return std::nullopt;
  const Time began = Time{} + Duration{static_cast<std::int64_t>(*o.speed_since * 1e6)};
  if (began > utc) throw host::BadInput("--speed-since: must be past; now it is " + std::to_string(utc.us / 1'000'000));
  return began;
}

/// How long nobody has flown, where the mission goes on that the record tells of.
board::Outage outage_of(const Options& o, const host::SafetyCopies& safety, const board::HostClock& host) {
  const bool goes_on = o.resume && safety.found() && !safety.found()->is_closed;
  return goes_on ? board::outage_since(*safety.found(), host) : board::Outage{};
}

/// The mission clock at sea. Of a mission that goes on it goes by the record; no wall clock that was set meanwhile, either way, is asked.
std::unique_ptr<board::Clock> clock_at_sea(const Options& o, const host::SafetyCopies& safety, const board::HostClock& host,
                                           const board::Outage& outage) {
  auto clock = std::make_unique<board::HostMissionClock>(host, o.speed, rehearsal_began(o, host.utc()));
  const bool goes_on = o.resume && safety.found() && !safety.found()->is_closed;
  if (goes_on && !o.speed_since) clock->go_on_since(safety.found()->mission_time, outage.passed);
  return clock;
}

std::vector<host::BusLock> lock_buses(const Options& o, const host::MissionFile& file) {
  if (o.simulation) return host::lock_buses(file, host::BusPlace::kVehicle);
  std::vector<host::BusLock> locks =
      host::lock_buses_at_sea(file, board::SafetyFolders::of_this_process().runtime.value_or(std::filesystem::path()));
  for (const host::BusLock& lock : locks) {
    if (!lock.stranger().empty())
      std::cerr << "earshotd: warning: " << host::printable(lock.stranger()) << ", and is no user of this vehicle: not heeded\n";
  }
  return locks;
}

/// @param safety  of a vehicle at sea; null in simulation
int fly(const Options& o, const board::HostClock& host, host::SafetyCopies* safety) {
  host::MissionJudge judge = board::judge_of(o.vehicle, venture_of(o));
  const host::MissionFile file = load(o, judge);
  const host::SignedSearch search = judge.load_search(file);
  std::unique_ptr<runtime::Runtime> runtime = make_runtime(file, search, o.mission.string());
  std::unique_ptr<board::BoardCore> board = make_board(o, file, search);
  const std::vector<host::BusLock> locks = lock_buses(o, file);
  board::PortSet ports;
  // At sea a link may come after the vehicle computer.
  if (o.simulation) {
    board::open_ports(file, host, host::IfMissing::kRefuse, board::WakesFor::kBlocks, ports);
  } else {
    board::open_ports(file, host, host::IfMissing::kKeepTrying, board::WakesFor::kLooks, ports);
  }
  if (const std::string down = ports.down(); !down.empty())
    std::cerr << "earshotd: these links are down; tried again once a second:\n" << down;
  // In lock-step with a simulator the first set-point is waited for.
  ports.settle(std::chrono::seconds(1));
  const board::Outage outage = safety == nullptr ? board::Outage{} : outage_of(o, *safety, host);
  std::unique_ptr<board::Clock> clock;
  if (o.simulation) {
    board::Simulation simulation = board::open_simulation({.domain = *o.simulation, .run = o.run, .port = ports.next_index()});
    clock = std::move(simulation.clock);
    ports.add(std::move(simulation.port));
  } else {
    clock = clock_at_sea(o, *safety, host, outage);
  }
  // A vehicle in mid-search must not be left alone with its last set-point because somebody's terminal closed or a key slipped.
  if (!o.simulation) {
    program::outlive_accidents();
    program::note_hang_ups();
  }
  program::stop_on_signals();  // up to here nothing is under way that would have to end in order
  // The journal of an earlier flight is not touched before a simulator has come, and that comes when it has judged its own input.
  const board::Waited waited =
      board::wait_for("earshotd", o.simulation ? "a simulator in DDS domain " + std::to_string(*o.simulation) : std::string(),
                      std::chrono::seconds(o.wait_s), [&](std::chrono::milliseconds most) { return clock->has_come(most); });
  if (waited != board::Waited::kCame) return waited == board::Waited::kStopped ? program::kStopped : kLost;
  judge.record_flight();
  board::Flight flight{.options = o,
                       .file = file,
                       .search = search,
                       .runtime = std::move(runtime),
                       .board = std::move(board),
                       .ports = ports,
                       .clock = *clock,
                       .host = host,
                       .manager = board::service_manager(o),
                       .safety = safety,
                       .outage = outage};
  return board::fly(flight);
}

int fly(const Options& o) {
  const bool is_at_sea = !o.check && !o.simulation;
  if (!is_at_sea) board::require_possible(o);
  if (o.check) return check(o);
  const board::HostClock host;
  if (o.simulation) return fly(o, host, nullptr);
  host::set_thread_stack(board::kThreadStackBytes);
  return board::fly_at_sea(o, host, [&](host::SafetyCopies& safety) {
    board::require_possible(o);  // options that do not go together are no reason either to leave a vehicle alone
    return fly(o, host, &safety);
  });
}

}  // namespace

int main(int argc, char** argv) {
  program::PatientStreams streams;  // a vehicle waits for nobody who reads, and does not end with him
  program::CommandLine line("earshotd",
                            "earshotd flies one mission: navigation and SNR in, frozen policy, set-points out.\n"
                            "Exit status: 0 the search ended DONE, or none was under way; 1 --prove-no-alloc found an allocation;\n"
                            "2 bad input (with --resume: and nothing was under way); 3 the simulator, the bus or the journal was\n"
                            "lost (with --resume also: another process flies here, or no port opens to bring the vehicle up by);\n"
                            "4 the search ended in ABORT: a rule, an operator, a memory that failed, or an outage after which it\n"
                            "could not go on; 5 a signal stopped a search under way; 130 stopped before the simulator came.");
  Options options;
  board::declare(line, options);
  bool has_begun = false;
  const int status = program::run(line, argc, argv, [&] {
    has_begun = true;
    streams.say_errors_as(
        [format = options.log_format()](std::string_view said, std::span<char> into) { return board::formatted(said, format, into); });
    options.names_out = std::ranges::count(line.given(), "--out") > 0;
    return fly(options);
  });
  // A command line that this program does not know (of another version) is no reason to leave a vehicle alone.
  return status == program::kBadInput && !has_begun ? board::come_up_by(argc, argv).value_or(status) : status;
}
