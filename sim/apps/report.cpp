// earshot-report: one page about one flight.

#include <CLI/CLI.hpp>
#include <filesystem>

#include "firmware/boards/linux/program.hpp"
#include "sim/apps/flight_record.hpp"
#include "sim/apps/report/flight_files.hpp"
#include "sim/apps/report/page.hpp"
#include "sim/apps/report/plots.hpp"

namespace {

int write_report(const std::filesystem::path& folder) {
  const earshot::report::Flight flight = earshot::report::read_flight(folder);
  earshot::simulation::write_whole(folder / "report.html",
                                   earshot::report::page(flight, earshot::report::map_svg(flight), earshot::report::history_svg(flight)));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "earshot report DIR reads the journal, track.csv, snr.csv and summary.json that a flight left in DIR and writes DIR/report.html,\n"
      "a page that needs no other file.\n"
      "Exit status: 0 written, 2 something of the flight cannot be read or the page cannot be made.",
      "earshot-report"};
  std::filesystem::path folder;
  app.add_option("DIR", folder, "folder of the flight")->required();
  return earshot::board::run_program(app, argc, argv, [&] { return write_report(folder); });
}
