// earshotd: the process that flies the vehicle.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/boards/linux/apps/earshotd_options.hpp"
#include "firmware/boards/linux/apps/end_report.hpp"
#include "firmware/boards/linux/apps/vehicle_trust.hpp"
#include "firmware/boards/linux/checklist/chart.hpp"
#include "firmware/boards/linux/checklist/checklist.hpp"
#include "firmware/boards/linux/checklist/doubts.hpp"
#include "firmware/boards/linux/core/board_core.hpp"
#include "firmware/boards/linux/core/core.hpp"
#include "firmware/boards/linux/host_clock.hpp"
#include "firmware/boards/linux/host_mission_clock.hpp"
#include "firmware/boards/linux/memory_proof.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/news/flight_news.hpp"
#include "firmware/boards/linux/news/health_words.hpp"
#include "firmware/boards/linux/news/line_writer.hpp"
#include "firmware/boards/linux/port_set.hpp"
#include "firmware/boards/linux/replay/resume.hpp"
#include "firmware/boards/linux/service/service_manager.hpp"
#include "firmware/boards/linux/simulation_plugin.hpp"
#include "firmware/boards/linux/waiting.hpp"
#include "firmware/core/crc32.hpp"
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
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/standard_streams.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "firmware/host/transport/serial_line.hpp"
#include "firmware/host/trust/vehicle_file.hpp"
#include "firmware/messages/health_words.hpp"
#include "firmware/runtime/runtime.hpp"

namespace {

using namespace earshot;

using board::Options;
using program::kLost;
using program::stop_requested;

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
  if (runtime->configure(file.mission, *search.policy.policy, *search.tables.tables) != Status::kOk)
    throw host::BadInput(mission_name + ": cannot be flown with the policy " + file.policy.string());
  return runtime;
}

/// The mission must fit this build, too: its refusals name file and key.
std::unique_ptr<board::BoardCore> make_board(const Options& o, const host::MissionFile& file, const host::SignedSearch& search) {
  if (!o.board) return nullptr;
  // At sea a vehicle must not be left with its last set-point; in simulation the board may be an emulator on a busy machine.
  const std::chrono::seconds patience(o.simulation ? 60 : 3);
  return std::make_unique<board::BoardCore>(host::SerialLine(*o.board), file.mission, search.policy.bytes, search.tables.bytes, patience);
}

host::JournalOptions journal_options(const Options& o) {
  constexpr std::uint64_t kMegabyte = 1'000'000;
  using J = host::JournalOptions;
  using Existing = host::ExistingJournal;
  const bool survives_power_cut = o.journal_survives.value_or(o.simulation ? "process" : "power-cut") == "power-cut";
  return {.when_full = o.simulation ? J::WhenFull::kWait : J::WhenFull::kDrop,
          .survives = survives_power_cut ? J::Survives::kPowerCut : J::Survives::kProcess,
          .existing = o.replace ? Existing::kReplace : (o.simulation && !o.resume ? Existing::kRefuse : Existing::kKeep),
          .limits = {.part_bytes = kMegabyte * o.journal_part_mb.value_or(0), .budget_bytes = kMegabyte * o.journal_budget_mb.value_or(0)}};
}

/// Beside the journal, under its name: what was decided can be explained only with what decided it. A disk that does not take it is no
/// reason to stay ashore.
/// @param extension  "policy", "tables"
void keep(std::span<const std::uint8_t> bytes, const std::string& extension, const host::OutputKind& kind,
          const std::filesystem::path& journal) {
  if (bytes.empty()) return;
  const std::filesystem::path kept = std::filesystem::path(journal).replace_extension("." + extension);
  try {
    host::require_writable(kept, kind, host::Replace::kOwnKind, "it stays");
    host::write_whole(kept, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const host::BadInput& e) {
    std::cerr << "earshotd: " << host::printable(e.what()) << "; the " << extension << " is in the journal\n";
  }
}

void keep(const host::SignedSearch& search, const std::filesystem::path& journal) {
  keep(search.policy.bytes, "policy", {"a .policy file", {"EARSHOTP", {}}}, journal);
  keep(search.tables.bytes, "tables", {"a .tables file", {"EARSHOTT", {}}}, journal);
}

/// In simulation the simulator's middleware does as it likes with memory.
void settle_memory(const Options& o) {
  if (o.simulation) return;
  const std::string remark = board::settle_memory();
  if (!remark.empty() && program::talk() != program::Talk::kQuiet) std::cerr << "earshotd: " << remark << "\n";
}

/// Of a vehicle at sea; a simulation is nobody's service.
board::ServiceManager service_manager(const Options& o) {
  board::ServiceManager manager(o.simulation ? board::ServiceEnvironment{} : board::ServiceEnvironment::of_this_process());
  if (!manager.complaint().empty()) std::cerr << "earshotd: warning: " << manager.complaint() << "\n";
  return manager;
}

/// What the mission is flown with.
struct Flight {
  const Options& options;
  const host::MissionFile& file;
  const host::SignedSearch& search;
  std::unique_ptr<runtime::Runtime> runtime;
  std::unique_ptr<board::BoardCore> board;  ///< that decides in its place; none: nobody does
  board::PortSet& ports;
  board::Clock& clock;
  board::ServiceManager manager;
};

/// Flies, and tells meanwhile what changes; all of it is told when this returns.
board::LoopResult fly(const Flight& f, board::MissionTurn& turn, board::MemoryProof& proof, Duration hold) {
  std::optional<board::LineWriter> writer;
  std::optional<board::FlightNews> news;
  if (program::talk() != program::Talk::kQuiet) {
    writer.emplace(STDERR_FILENO);
    news.emplace(f.ports, *writer, f.options.log_format());
    turn.tell(*news);
  }
  settle_memory(f.options);
  if (f.options.prove_no_alloc) proof.arm();
  const board::Pace pace{.period = f.file.step_period, .turns = f.options.simulation ? host::Turns::kPeriodic : f.file.turns};
  const board::LoopResult result = board::fly(turn, f.ports, f.clock, pace, stop_requested, hold);
  if (f.options.prove_no_alloc) proof.disarm(result);
  const std::uint64_t left_out = writer ? writer->left_out() : 0;
  writer.reset();
  if (left_out > 0) std::cerr << "earshotd: " << left_out << " lines like these were left out, because nobody read them in time\n";
  return result;
}

/// The mission that the newest journal in the folder did not end. Nothing: a new one begins.
std::optional<board::Unfinished> unfinished_mission(Flight& f, const std::filesystem::path& wanted) {
  if (!f.options.resume) return std::nullopt;
  f.manager.ask_for(std::chrono::minutes(30));  // the journal of a month is read again
  return board::find_unfinished(
      wanted, {.mission = f.file.mission, .policy_crc32 = crc32(f.search.policy.bytes), .tables_crc32 = crc32(f.search.tables.bytes)},
      f.options.simulation ? board::GoOnAfter::kLastTurn : board::GoOnAfter::kLastInput, f.clock.now());
}

/// Begins the mission, or goes on with it. @return how long its first turn waits for its sensors
Duration begin(const Flight& f, const board::Resumption* before, const std::filesystem::path& journal, board::MissionTurn& turn) {
  const std::string build = program::version() + " " + program::build_commit();
  constexpr std::chrono::milliseconds kAtSea{100};
  constexpr std::chrono::milliseconds kInLockStep{60'000};  // the simulator waits
  if (f.options.resume) turn.write_ahead(f.options.simulation ? kInLockStep : kAtSea);
  if (before != nullptr) {
    f.clock.go_on_after(before->last.health);
    f.ports.count_on_from(before->memory.reports);
    turn.go_on_after(*before, build);
    if (program::talk() != program::Talk::kQuiet)
      std::cerr << "earshotd: goes on from " << host::printable(journal.string()) << ": " << board::to_string(*before, f.clock.now())
                << "\n";
    return f.options.simulation ? Duration{} : board::hold_of(f.file.mission, f.file.hearing);
  }
  turn.record_mission(f.file.mission, {.policy = f.search.policy.bytes, .tables = f.search.tables.bytes, .build = build});
  if (!f.options.simulation && program::talk() != program::Talk::kQuiet) {
    std::cerr << "earshotd: waiting for navigation, SNR and an operator's START, as long as it takes, on\n"
              << f.ports.description() << "earshotd: journal " << host::printable(journal.string()) << "\n";
  }
  return {};
}

/// @return exit status
int fly(Flight& f) {
  std::filesystem::create_directories(f.options.out);
  const std::filesystem::path wanted = f.options.out / "journal.lcmlog";
  std::optional<board::Unfinished> unfinished = unfinished_mission(f, wanted);
  if (f.options.replace)
    host::require_writable(wanted, host::kJournalOutput, host::Replace::kOwnKind, "move it away, or name another folder with --out");
  host::Journal journal = unfinished
                              ? host::Journal(std::move(unfinished->file), unfinished->before.next_number, journal_options(f.options))
                              : host::Journal(wanted, journal_options(f.options));
  keep(f.search, journal.path());
  if (unfinished) f.runtime = std::move(unfinished->before.runtime);
  board::OwnCore own(*f.runtime);
  board::MissionTurn turn(f.board ? static_cast<board::Core&>(*f.board) : own, f.ports, journal, f.clock);
  turn.report_to(f.manager);
  turn.begin_parts_when(program::has_hung_up);
  const Duration hold = begin(f, unfinished ? &unfinished->before : nullptr, journal.path(), turn);
  board::MemoryProof proof;
  board::LoopResult result;
  try {
    result = fly(f, turn, proof, hold);
  } catch (const std::exception& e) {  // no bad input: the journal has begun, and its destructor keeps it
    std::cerr << "earshotd: " << e.what() << "; journal up to then: " << host::printable(journal.path().string()) << "\n";
    return kLost;
  }
  journal.conclude(board::closing_record_of(result));
  const Status kept = journal.close();
  const int status = board::report(result, f.clock, f.ports, journal.path());
  if (f.board && program::talk() == program::Talk::kVerbose) std::cerr << "earshotd: " << f.board->remark() << "\n";
  const int proven = f.options.prove_no_alloc ? board::report(proof, f.ports) : program::kDone;
  const int in_journal = board::report(journal, kept, wanted, !f.options.simulation);
  return in_journal != program::kDone ? in_journal : (proven != program::kDone ? proven : status);
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

int fly(const Options& o) {
  require_possible(o);
  if (o.check) return check(o);
  host::MissionJudge judge = board::judge_of(o.vehicle, venture_of(o));
  const host::MissionFile file = load(o, judge);
  const host::SignedSearch search = judge.load_search(file);
  std::unique_ptr<runtime::Runtime> runtime = make_runtime(file, search, o.mission.string());
  std::unique_ptr<board::BoardCore> board = make_board(o, file, search);
  const std::vector<host::BusLock> locks = host::lock_buses(file, o.simulation ? std::optional(host::BusPlace::kVehicle) : std::nullopt);
  if (!o.simulation) host::set_thread_stack(board::kThreadStackBytes);
  const board::HostClock host;
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
  std::unique_ptr<board::Clock> clock;
  if (o.simulation) {
    board::Simulation simulation = board::open_simulation({.domain = *o.simulation, .run = o.run, .port = ports.next_index()});
    clock = std::move(simulation.clock);
    ports.add(std::move(simulation.port));
  } else {
    clock = std::make_unique<board::HostMissionClock>(host, o.speed, rehearsal_began(o, host.utc()));
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
  Flight flight{.options = o,
                .file = file,
                .search = search,
                .runtime = std::move(runtime),
                .board = std::move(board),
                .ports = ports,
                .clock = *clock,
                .manager = service_manager(o)};
  return fly(flight);
}

}  // namespace

int main(int argc, char** argv) {
  program::PatientStreams streams;  // a vehicle waits for nobody who reads, and does not end with him
  program::CommandLine line("earshotd",
                            "earshotd flies one mission: navigation and SNR in, frozen policy, set-points out.\n"
                            "Exit status: 0 the search ended DONE, or none was under way; 1 --prove-no-alloc found an allocation;\n"
                            "2 bad input; 3 the simulator, the bus or the journal was lost; 4 the search ended in ABORT;\n"
                            "5 a signal stopped a search under way; 130 stopped before the simulator came.");
  Options options;
  board::declare(line, options);
  return program::run(line, argc, argv, [&] {
    streams.say_errors_as(
        [format = options.log_format()](std::string_view said, std::span<char> into) { return board::formatted(said, format, into); });
    options.names_out = std::ranges::count(line.given(), "--out") > 0;
    return fly(options);
  });
}
