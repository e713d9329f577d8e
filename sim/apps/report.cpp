// earshot-report: one page about one flight.

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <iostream>

#include "firmware/config_file/table_reader.hpp"
#include "sim/apps/flight_record.hpp"
#include "sim/apps/report/flight_files.hpp"
#include "sim/apps/report/page.hpp"
#include "sim/apps/report/plots.hpp"

int main(int argc, char** argv) {
  CLI::App app{
      "earshot report DIR reads the journal, track.csv, snr.csv and summary.json that a flight left in DIR and writes DIR/report.html,\n"
      "a page that needs no other file."};
  std::filesystem::path folder;
  app.add_option("DIR", folder, "folder of the flight")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  try {
    const earshot::report::Flight flight = earshot::report::read_flight(folder);
    earshot::simulation::write_whole(folder / "report.html",
                                     earshot::report::page(flight, earshot::report::map_svg(flight), earshot::report::history_svg(flight)));
  } catch (const earshot::config_file::BadInput& e) {
    std::cerr << e.what() << "\n";
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "earshot-report: " << e.what() << "\n";
    return 1;
  }
  return 0;
}
