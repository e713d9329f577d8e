#include "firmware/boards/linux/apps/run_modes.hpp"

#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include "firmware/boards/linux/apps/composition.hpp"
#include "firmware/boards/linux/apps/vehicle_trust.hpp"
#include "firmware/desk/checklist/chart.hpp"
#include "firmware/desk/checklist/checklist.hpp"
#include "firmware/desk/checklist/mission_warnings.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/talk.hpp"

namespace earshot::board {
namespace {

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
std::string warning_about_journal(const Options& o) {
  try {
    require_room_for_journal(o);
    return {};
  } catch (const host::BadInput& e) {
    if (o.names_out) throw;
    return std::string(e.what()) + "; the flight needs another folder for its journal: --out names it";
  }
}

}  // namespace

int check(const Options& o) {
  host::MissionVerifier verifier = verifier_at_sea(o.vehicle, host::Counting::kVerified);
  const host::MissionFile file = load_mission_for_sea(o, verifier);
  const host::SignedSearch search = verifier.load_search(file);
  (void)make_runtime(file, search, o.mission.string());
  const std::string about_journal = warning_about_journal(o);
  if (o.chart) {
    host::require_writable(*o.chart, host::kSvgOutput, host::Replace::kOwnKind, "name another file");
    host::write_whole(*o.chart, chart(file.mission, host::printable(o.mission.filename().string())));
  }
  program::print() << checklist(file, search, o.mission.string(), signatures_of(verifier, search));
  if (o.chart) program::print() << "chart         " << host::printable(o.chart->string()) << "\n";
  std::vector<std::string> warnings = mission_warnings(file);
  if (!about_journal.empty()) warnings.push_back(about_journal);
  // Of a mission that is flown after `--quiet --check` nobody may say that he was not told.
  std::ostream& destination = program::talk() == program::Talk::kQuiet ? std::cerr : program::print();
  for (const std::string& warning : warnings) destination << "doubt: " << warning << "\n";
  program::print() << "ready to dive" << (warnings.empty() ? "" : ", but for what is in doubt") << "\n";
  return program::kDone;
}

}  // namespace earshot::board
