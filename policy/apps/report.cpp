// earshot-report: one page about one flight.

#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/run.hpp"
#include "policy/report/document/flight_reading.hpp"
#include "policy/report/document/json_values.hpp"
#include "policy/report/flight_files.hpp"
#include "policy/report/page/page_template.hpp"

namespace {

using namespace earshot;

const host::OutputKind kFlightJson{"a flight of earshot report (JSON)", {"{\"format\":", {}}};

/// Reports on standard error what the page lacks. @return the exit status
int report_missing(const std::filesystem::path& folder, const report::GrowingFlight& flight) {
  const std::vector<std::string> missing = flight.files().missing;
  for (const std::string& name : missing) std::cerr << host::printable((folder / name).string()) << ": not there; the page is without it\n";
  if (!flight.journal().is_whole())
    std::cerr << host::printable(report::journal_of_flight(folder).string()) << ": " << report::lack_of(flight.journal()) << "\n";
  if (!flight.unexplained().empty())
    std::cerr << host::printable(flight.unexplained()) << "; the page is without the reasons of its decisions\n";
  const bool is_whole = missing.empty() && flight.journal().is_whole() && flight.unexplained().empty();
  return is_whole ? program::kDone : program::kIncomplete;
}

/// DIR/report.html; of DIR/journal-2.lcmlog DIR/journal-2.html.
std::filesystem::path page_of(std::filesystem::path folder_or_journal) {
  return std::filesystem::is_directory(folder_or_journal) ? folder_or_journal / "report.html"
                                                          : folder_or_journal.replace_extension(".html");
}

/// Of several journals in a folder, which one the page is of.
void name_journal(const std::filesystem::path& folder) {
  const std::filesystem::path journal = report::journal_of_flight(folder);
  if (journal == folder || journal.filename() == report::kJournalName) return;
  program::print() << "it is of " << host::printable(journal.filename().string()) << ", the newest journal there\n";
}

/// "8 steps, 9 decisions": a mission may end within a step.
std::string steps_and_decisions(const report::GrowingFlight& flight) {
  const std::string decisions = host::counted(flight.journal().decisions.size(), "decision");
  const nlohmann::json summary = flight.files().summary;
  if (!summary.is_null()) return host::counted(summary.at("steps").get<std::size_t>(), "step") + ", " + decisions;
  return flight.by_journal() ? host::counted(flight.by_journal()->steps_taken, "step") + ", " + decisions : decisions;
}

int write_report(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& json, host::Replace replace) {
  const std::filesystem::path file = json ? *json : page_of(folder);
  host::DistinctFiles read;
  read.read("DIR", report::files_of_flight(folder));
  const host::Output output = json ? host::Output{"--json", file, kFlightJson} : host::Output{"the page", file, host::kHtmlOutput};
  host::require_writable(std::move(read), std::array{output}, replace);
  const std::unique_ptr<report::GrowingFlight> flight = report::read_to_its_end(report::surroundings_of(folder));
  const std::string text = report::json_text(flight->whole());
  host::write_whole(file, json ? text + "\n" : report::page_with(text));
  program::print() << "wrote " << host::printable(file.string()) << ": " << steps_and_decisions(*flight) << "\n";
  program::detail() << folder.string() << ": " << flight->journal().decisions.size() << " decisions in " << flight->journal().records
                    << " records of the journal\n";
  name_journal(folder);
  return report_missing(folder, *flight);
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot report",
      "earshot report DIR reads the journal, the policy, snr.csv and summary.json that a flight left in DIR and writes\n"
      "DIR/report.html, a page that needs no other file. A flight at sea leaves its journal and policy alone, and its page is of these;\n"
      "of several journals it is of the newest; earshot report DIR/journal-2.lcmlog writes the page of another, DIR/journal-2.html.\n"
      "Exit status: 0 written, 1 written of what is there: a file is missing, the journal is cut or damaged, or its policy cannot be "
      "read:\n"
      "standard error reports which,\n"
      "2 something of the flight cannot be read or the page cannot be made.");
  std::filesystem::path folder;
  std::optional<std::filesystem::path> json;
  bool force = false;
  line.option("DIR", &folder, "folder of the flight, or one of several journals in it").required();
  line.option("--json", &json, "write what the page is given of the flight to this file instead of the page");
  line.flag("--force", &force, command_line::kForceHelp);
  int status = program::kDone;
  const int refused = command_line::run(line, argc, argv, [&] { status = write_report(folder, json, host::replaced_by(force)); });
  return refused != program::kDone ? refused : status;
}
