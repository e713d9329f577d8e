#include "firmware/boards/linux/apps/flight.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <future>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/boards/linux/apps/end_report.hpp"
#include "firmware/boards/linux/event_log/event_log.hpp"
#include "firmware/boards/linux/event_log/line_writer.hpp"
#include "firmware/boards/linux/memory_proof.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/outage/held_orders.hpp"
#include "firmware/boards/linux/outage/kept_vehicle.hpp"
#include "firmware/boards/linux/outage/meanwhile.hpp"
#include "firmware/boards/linux/outage/safety_log.hpp"
#include "firmware/boards/linux/replay/resume.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/program/version.hpp"

namespace earshot::board {
namespace {

using program::kLost;
using program::stop_requested;

/// With disks, where nothing is under way.
constexpr std::chrono::seconds kAshore{3};

host::JournalOptions journal_options(const Options& o, const FlightTerms& terms) {
  constexpr std::uint64_t kMegabyte = 1'000'000;
  using Survives = host::JournalOptions::Survives;
  const Survives survives =
      o.journal_survives ? (*o.journal_survives == "power-cut" ? Survives::kPowerCut : Survives::kProcess) : terms.journal_survives;
  return {.when_full = terms.when_journal_is_full,
          .survives = survives,
          .existing = o.replace ? host::ExistingJournal::kReplace : terms.existing_journal,
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

/// A computer that cannot make its thread flies without an event log.
void open_event_log(std::optional<LineWriter>& writer) {
  try {
    writer.emplace(STDERR_FILENO);
  } catch (const std::system_error& e) {
    std::cerr << "earshotd: warning: " << e.what() << ": it flies without reporting what changes; the journal has it\n";
  }
}

/// Flies, and tells meanwhile what changes; all of it is told when this returns.
LoopResult fly_on(const Flight& f, MissionTurn& turn, MemoryProof& proof, const Hold& hold) {
  std::optional<LineWriter> writer;
  std::optional<EventLog> event_log;
  if (program::talk() != program::Talk::kQuiet) open_event_log(writer);
  if (writer) {
    event_log.emplace(f.ports, *writer, f.options.log_format());
    turn.report_to(*event_log);
  }
  if (f.terms.settles_memory) report_settled_memory();
  if (f.options.prove_no_alloc) proof.arm();
  const Pace pace{.period = f.file.step_period, .turns = f.terms.turns};
  const LoopResult result = fly(turn, f.ports, f.clock, pace, stop_requested, hold);
  if (f.options.prove_no_alloc) proof.disarm(result);
  const std::uint64_t left_out = writer ? writer->left_out() : 0;
  writer.reset();
  if (left_out > 0) std::cerr << "earshotd: " << left_out << " lines like these were left out, because nobody read them in time\n";
  return result;
}

/// With this start among its starts.
host::SafetyRecord counted(host::SafetyRecord record) {
  ++record.starts;
  return record;
}

/// Of a journal that no safety record of this vehicle names, nobody knows whose orders stand in it.
void report_others_journal(const std::filesystem::path& wanted) {
  if (const std::optional<std::filesystem::path> newest = host::newest_journal(wanted); newest)
    std::cerr << "earshotd: warning: " << host::printable(newest->string())
              << ": no safety record of this vehicle names it: it is left, and a new mission begins\n";
}

/// For so long nobody commands while the journal is read and sensors are waited for; from then on somebody does.
constexpr std::chrono::seconds kUncommanded{5};
constexpr std::chrono::milliseconds kBetweenTurns{100};  // a bus wants to be served so often

/// Nothing ends a reading that is under way but the program's end; the journal is as if it had crashed.
[[noreturn]] void stop_meanwhile(SafetyLog& safety, Meanwhile& meanwhile) {
  for (int setpoints_sent = 0; setpoints_sent < kLastSetpoints; ++setpoints_sent) meanwhile.turn();
  std::cerr << "earshotd: stopped by a signal while it read the journal; the vehicle was ordered to stop and come up\n";
  (void)safety.abort(kAshore);
  if (!safety.close(kAshore)) std::cerr << kStaysUnderWay;
  std::_Exit(program::kInterrupted);
}

/// Reads the journal again; where that takes long, the vehicle is ordered to stop and come up meanwhile. @return what find_unfinished()
/// does
std::optional<Unfinished> read_again(const Flight& f, const std::filesystem::path& wanted, const Flown& flown, SafetyLog& safety,
                                     Meanwhile& meanwhile) {
  const std::uint32_t mark = f.safety->found()->journal_crc32;
  auto reading = std::async(std::launch::async, [&] { return find_unfinished(wanted, flown, GoOnAfter::kLastInput, mark); });
  if (reading.wait_for(kUncommanded) == std::future_status::timeout) {
    std::cerr << "earshotd: reading the journal takes long; the vehicle is ordered to stop and come up meanwhile\n";
    do {
      meanwhile.turn();
      if (stop_requested) stop_meanwhile(safety, meanwhile);
    } while (reading.wait_for(kBetweenTurns) == std::future_status::timeout);
  }
  return reading.get();
}

/// The mission that a journal in the folder did not end. Nothing: a new one begins.
/// @throws host::BadInput when the vehicle is under way, and its mission cannot go on
std::optional<Unfinished> unfinished_mission(Flight& f, const std::filesystem::path& wanted, std::optional<SafetyLog>& safety,
                                             std::optional<Meanwhile>& meanwhile) {
  if (!f.options.resume) return std::nullopt;
  const Flown flown{.mission = f.file.mission, .policy_crc32 = crc32(f.search.policy.bytes), .tables_crc32 = crc32(f.search.tables.bytes)};
  f.manager.ask_for(std::chrono::minutes(30));  // the journal of a month is read again
  if (f.safety == nullptr) return find_unfinished(wanted, flown, GoOnAfter::kLastTurn);
  if (!f.safety->found()) report_others_journal(wanted);
  const host::SafetyRecord* const record = f.record;
  if (record == nullptr) return std::nullopt;
  std::optional<Unfinished> unfinished;
  try {
    unfinished = meanwhile ? read_again(f, wanted, flown, *safety, *meanwhile)
                           : find_unfinished(wanted, flown, GoOnAfter::kLastInput, record->journal_crc32);
  } catch (const host::BadInput& e) {
    if (is_under_way(*record)) throw;
    f.holds_orders = record->kept_crc32 == crc32(kept_vehicle(f.file));
    std::cerr << "earshotd: " << host::printable(e.what()) << "; nothing was under way: a new mission begins\n";
    return std::nullopt;
  }
  if (!unfinished) {
    if (!is_under_way(*record)) return std::nullopt;
    const bool was_stopped = was_ended_in_order(host::journal_marked(wanted, record->journal_crc32).value());
    throw host::BadInput(wanted.string() + ": the mission that was under way cannot go on: " +
                         (was_stopped ? "its program was stopped before the vehicle was up" : "its journal holds no turn"));
  }
  f.holds_orders = true;
  f.clock.be_at_least(unfinished->before.memory.last + f.outage.least);
  const Resumption& before = unfinished->before;
  const host::SafetyRecord standing = f.safety->newest().value();  // a weight may have been released meanwhile
  const HeldOrders held = held_orders(standing, before.last, before.runtime->mission(), f.clock.now());
  if (!held.impossible.empty())
    throw host::BadInput(unfinished->file.path().string() + ": the mission cannot go on from it: " + std::string(held.impossible));
  return unfinished;
}

/// What the safety record knows and the mission does not: ordered anew, as inputs that the journal holds.
void order_what_held(const Flight& f, const runtime::Outputs& last, Core& core, MissionTurn& turn) {
  if (!f.holds_orders) return;
  for (const messages::OperatorCommand& order : held_orders(*f.record, last, core.mission(), f.clock.now()).orders)
    turn.take(kOwnPort, order);
  const bool is_over = f.record->end_reason != messages::EndReason::kNone;
  if (!is_over && !keeps_limits_of(*f.record, core.mission()))
    throw host::BadInput("the limits that an operator made tighter cannot be kept by the mission in its journal");
}

/// Begins the mission, or goes on with it. @return how long its first turn waits for its sensors
Duration begin(const Flight& f, const Resumption* before, const std::filesystem::path& journal, SafetyLog* safety, MissionTurn& turn) {
  const std::string build = program::version() + " " + program::build_commit();
  if (f.options.resume) turn.write_ahead(f.terms.write_ahead_patience);
  if (before != nullptr) {
    f.clock.go_on_after(before->last.health);
    f.ports.count_on_from(before->memory.reports);
    turn.go_on_after(*before, build);
    if (program::talk() != program::Talk::kQuiet)
      std::cerr << "earshotd: goes on from " << host::printable(journal.string()) << ": " << to_string(*before, f.clock.now()) << "\n";
    const bool is_search = before->last.health.state == messages::MissionState::kSearch;
    return f.terms.waits_for_others && is_search ? hold_of(f.file.mission, f.file.hearing) : Duration{};
  }
  const std::uint32_t mark =
      turn.record_mission(f.file.mission, {.policy = f.search.policy.bytes, .tables = f.search.tables.bytes, .build = build});
  const bool is_durable = safety == nullptr || safety->begin(f.clock.now(), f.file.mission, mark, kept_vehicle(f.file), kAshore);
  if (const std::string refused = is_durable ? std::string() : f.safety->complaints(); !refused.empty())
    std::cerr << "earshotd: warning: no disk takes the safety record (" << host::printable(refused)
              << "): a restart may forget an ABORT; tried again\n";
  if (f.terms.waits_for_others && program::talk() != program::Talk::kQuiet) {
    std::cerr << "earshotd: waiting for navigation, SNR and an operator's START, as long as it takes, on\n"
              << f.ports.description() << "earshotd: journal " << host::printable(journal.string()) << "\n";
  }
  return {};
}

/// @param began  when the reading did
Time end_of_silence(const Flight& f, std::chrono::steady_clock::time_point began) {
  const std::chrono::duration<double> left = kUncommanded - (std::chrono::steady_clock::now() - began);
  return f.clock.now() + Duration{static_cast<std::int64_t>(std::max(left.count(), 0.0) * f.options.speed * 1e6)};
}

}  // namespace

void report_settled_memory() {
  const std::string remark = settle_memory();
  if (!remark.empty() && program::talk() != program::Talk::kQuiet) std::cerr << "earshotd: " << remark << "\n";
}

ServiceManager service_manager() {
  ServiceManager manager(ServiceEnvironment::of_this_process());
  if (!manager.complaint().empty()) std::cerr << "earshotd: warning: " << manager.complaint() << "\n";
  return manager;
}

int fly(Flight& f) {
  std::filesystem::create_directories(f.options.out);
  const std::filesystem::path wanted = f.options.out / "journal.lcmlog";
  std::optional<SafetyLog> safety;
  std::optional<Meanwhile> meanwhile;
  const auto began = std::chrono::steady_clock::now();
  if (f.record != nullptr) {
    safety.emplace(*f.safety, f.host, counted(*f.record));
    if (is_under_way(*f.record)) meanwhile.emplace(f.file.mission, f.ports, f.clock, *safety);
  }
  std::optional<Unfinished> unfinished = unfinished_mission(f, wanted, safety, meanwhile);
  if (f.options.replace)
    host::require_writable(wanted, host::kJournalOutput, host::Replace::kOwnKind, "move it away, or name another folder with --out");
  host::Journal journal =
      unfinished ? host::Journal(std::move(unfinished->file), unfinished->before.next_number, journal_options(f.options, f.terms))
                 : host::Journal(wanted, journal_options(f.options, f.terms));
  keep(f.search, journal.path());
  if (unfinished) f.runtime = std::move(unfinished->before.runtime);
  OwnCore own(*f.runtime);
  Core& core = f.board ? static_cast<Core&>(*f.board) : own;
  MissionTurn turn(core, f.ports, journal, f.clock);
  if (f.safety != nullptr && !unfinished) safety.emplace(*f.safety, f.host, host::SafetyRecord{});
  turn.report_to(f.manager);
  turn.begin_parts_when(program::has_hung_up);
  Hold hold{.most = begin(f, unfinished ? &unfinished->before : nullptr, journal.path(), safety ? &*safety : nullptr, turn)};
  order_what_held(f, turn.outputs(), core, turn);
  if (meanwhile && meanwhile->abort()) turn.take(meanwhile->abort()->first, meanwhile->abort()->second);
  if (meanwhile && hold.most > Duration{}) {
    meanwhile->pass_on_to(turn);
    hold.meanwhile = &*meanwhile;
    hold.meanwhile_from = end_of_silence(f, began);
  }
  if (safety) turn.keep_safe(*safety);
  MemoryProof proof;
  LoopResult result;
  try {
    result = fly_on(f, turn, proof, hold);
  } catch (const std::exception& e) {  // no bad input: the journal has begun, and its destructor keeps it
    turn.end();
    std::cerr << "earshotd: " << e.what() << "; journal up to then: " << host::printable(journal.path().string()) << "\n";
    return kLost;
  }
  turn.end();
  if (result.end == LoopEnd::kOvertaken) return report(result, f.clock, f.ports, journal.path());
  if (safety && result.end == LoopEnd::kStopped && !safety->close(kAshore) && f.options.resume) std::cerr << kStaysUnderWay;
  journal.conclude(closing_record_of(result));
  const Status kept = journal.close();
  const int status = report(result, f.clock, f.ports, journal.path());
  if (f.board && program::talk() == program::Talk::kVerbose) std::cerr << "earshotd: " << f.board->remark() << "\n";
  const int proven = f.options.prove_no_alloc ? report(proof, f.ports) : program::kDone;
  const int in_journal = report(journal, kept, wanted, f.safety != nullptr);
  return in_journal != program::kDone ? in_journal : (proven != program::kDone ? proven : status);
}

}  // namespace earshot::board
