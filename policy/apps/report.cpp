// earshot-report: one page about one flight.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "firmware/config_file/table_reader.hpp"
#include "policy/apps/program.hpp"
#include "policy/report/flight_files.hpp"
#include "policy/report/page.hpp"
#include "policy/report/plots.hpp"

namespace {

using namespace earshot;

void write_report(const std::filesystem::path& folder, host::Replace replace) try {
  const std::filesystem::path page = folder / "report.html";
  const report::Flight flight = report::read_flight(folder);
  const report::Pictures pictures{.map = report::map_svg(flight), .history = report::history_svg(flight)};
  host::require_writable(page, host::kHtmlOutput, replace);
  host::write_whole(page, report::page(flight, pictures, report::explain_flight(folder)));
} catch (const nlohmann::json::exception& e) {
  throw config_file::BadInput((folder / "summary.json").string() + ": " + e.what());
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot report",
      "earshot report DIR reads the journal, the policy, track.csv, snr.csv and summary.json that a flight left in DIR and writes\n"
      "DIR/report.html, a page that needs no other file.\n"
      "Exit status: 0 written, 2 something of the flight cannot be read or the page cannot be made.");
  std::filesystem::path folder;
  bool force = false;
  line.option("DIR", &folder, "folder of the flight").required();
  line.flag("--force", &force, apps::kForceHelp);
  return apps::run_program(line, argc, argv, [&] { write_report(folder, host::replaced_by(force)); });
}
