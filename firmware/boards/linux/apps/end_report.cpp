#include "firmware/boards/linux/apps/end_report.hpp"

#include <iostream>
#include <string>

#include "firmware/boards/linux/event_log/health_words.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/health_words.hpp"

namespace earshot::board {
namespace {

bool is_talkative() {
  return program::talk() != program::Talk::kQuiet;
}

/// What became of the mission, for scripts and service managers. @param found_in  its state when it ended, or was told to
int status_of(messages::MissionState found_in) {
  switch (found_in) {
    case messages::MissionState::kStandby:
    case messages::MissionState::kDone:
      return program::kDone;
    case messages::MissionState::kSearch:
      return program::kInterrupted;
    case messages::MissionState::kAbort:
      return program::kAborted;
  }
  return program::kAborted;
}

}  // namespace

int report(const LoopResult& result, const Clock& clock, const PortSet& ports, const std::filesystem::path& journal) {
  const std::string after = " after " + std::to_string((result.time - result.began).us / 1'000'000) + " s";
  const std::string state = to_string(result.last.health);
  const std::string file = host::printable(journal.string());
  const std::string kept = journal.empty() ? "no journal was kept" : "journal " + file;
  for (const std::string& remark : ports.remarks()) {
    if (is_talkative()) std::cerr << "earshotd: " << remark << "\n";
  }
  for (const std::string& strangers : ports.strangers()) std::cerr << "earshotd: " << strangers << "\n";
  if (const std::string remark = clock.remark(); !remark.empty()) std::cerr << "earshotd: " << remark << "\n";
  switch (result.end) {
    case LoopEnd::kMissionOver:
      if (is_talkative()) std::cerr << "earshotd: " << state << "; " << kept << "\n";
      return status_of(result.last.health.state);
    case LoopEnd::kStopped:
      if (is_talkative())
        std::cerr << "earshotd: stopped by a signal" << after << ", in " << messages::to_string(result.found_in) << "; it ended in "
                  << to_string(result.last.health, result.found_in) << "; " << kept << "\n";
      return status_of(result.found_in);
    case LoopEnd::kClockLost:
      std::cerr << "earshotd: lost " << clock.lost() << after << ", in " << state << "; "
                << (journal.empty() ? kept : "journal up to then: " + file) << "\n";
      return program::kLost;
    case LoopEnd::kOvertaken:
      std::cerr << "earshotd: this program hung" << after << ", in " << state
                << ", and another commands the vehicle since then; journal up to then: " << kept << "\n";
      return program::kLost;
  }
  return program::kLost;
}

int report(const MemoryProof& proof, const PortSet& ports) {
  program::print() << proof.bill(ports);
  (proof.holds() ? program::print() : std::cerr) << "earshotd: " << proof.verdict() << std::flush;
  if (const std::string remark = proof.remark(); !remark.empty()) std::cerr << "earshotd: warning: " << remark << "\n";
  return proof.holds() ? program::kDone : program::kIncomplete;
}

int report(const host::Journal& journal, Status closed, const std::filesystem::path& wanted, bool is_at_sea) {
  const host::JournalCounters counters = journal.counters();
  if (is_at_sea && is_talkative())
    std::cerr << "earshotd: every record that is in the journal was there within " << host::decimals(journal.longest_wait_s(), 3)
              << " s, which is what a power cut could have cost\n";
  if (counters.deleted > 0) {
    const std::string last = host::named(wanted, {.journal = counters.last_deleted}).string();
    std::cerr << "earshotd: " << counters.deleted << " journals of earlier flights were deleted to stay within --journal-budget-mb, up to "
              << host::printable(last) << "\n";
  }
  if (closed == Status::kOk && counters.all_lost() == 0) return program::kDone;
  std::cerr << "earshotd: the journal is not whole: " << host::counted(counters.all_lost(), "record")
            << " lost: " << journal::to_string(host::lost_records(counters.lost)) << "; " << host::counted(counters.write_errors, "write")
            << " failed\n";
  return program::kLost;
}

}  // namespace earshot::board
