// earshot init: a folder with a mission and an ocean of one's own.

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/transport/interface_name.hpp"
#include "firmware/host/transport/lcm_url.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/run.hpp"
#include "policy/own_search/own_files.hpp"
#include "policy/own_search/own_folder.hpp"

namespace {

using namespace earshot;
namespace fs = std::filesystem;

struct Options {
  std::filesystem::path folder;
  own_search::OwnSearch search;
  bool force = false;
};

void add_number(program::CommandLine& line, const char* name, double& value, own_search::Bounds range, const char* what) {
  line.option(name, &value, what).between(range.lowest, range.highest).shows_default();
}

std::string complaint_about_url(const std::string& url) {
  try {
    (void)host::parse_lcm_url(url);
    return {};
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
}

void add_options(program::CommandLine& line, Options& o) {
  own_search::OwnSearch& s = o.search;
  line.option("DIR", &o.folder, "folder to make; one that is there must be empty").required();
  add_number(line, "--area-north-m", s.area_north_m, own_search::kSide_m, "size of the area from south to north, metres");
  add_number(line, "--area-east-m", s.area_east_m, own_search::kSide_m, "size of the area from west to east, metres");
  add_number(line, "--latitude-deg", s.latitude_deg, own_search::kLatitude_deg, "of the area's south-west corner");
  add_number(line, "--longitude-deg", s.longitude_deg, own_search::kLongitude_deg, "of the area's south-west corner");
  add_number(line, "--depth-m", s.depth_m, own_search::kDepth_m, "depth that the vehicle searches at, metres");
  add_number(line, "--speed-mps", s.speed_mps, own_search::kSpeed_mps, "the vehicle's speed through the water, metres per second");
  add_number(line, "--frequency-hz", s.frequency_hz, own_search::kFrequency_hz, "of the sound that is searched for");
  add_number(line, "--sea-floor-m", s.sea_floor_m, own_search::kSeaFloor_m, "depth of the sea floor in ocean.toml, metres");
  add_number(line, "--source-level-db", s.source_level_db, own_search::kSourceLevel_db,
             "level of the source in ocean.toml, dB re 1 uPa at 1 m");
  line.option(
          "--noise-db", &s.noise_db,
          "noise in the detector's band in ocean.toml, dB re 1 uPa (90 at 20 Hz, at another frequency as Wenz's curves differ from that)")
      .between(own_search::kNoise_db.lowest, own_search::kNoise_db.highest);
  line.option("--bus", &s.bus,
              "how the vehicle computer speaks to the vehicle: lcm; can (NMEA 2000); mixed: navigation and set-points over CAN, the rest "
              "over LCM")
      .one_of({"lcm", "can", "mixed"})
      .shows_default();
  line.option("--lcm-url", &s.lcm_url, "LCM network of the vehicle").checked(complaint_about_url).shows_default();
  line.option("--can-interface", &s.can_interface, "CAN interface of the vehicle")
      .checked(
          [](const std::string& name) { return host::is_interface_name(name) ? std::string() : std::string(host::kInterfaceNameRule); })
      .shows_default();
  line.flag("--hear", &s.hears,
            "the vehicle has a hydrophone, and measures the SNR itself: the mission's tables for it, and no port that brings one; "
            "for a sound of 9.1 to 740 Hz");
  line.option("--battery-percent", &s.battery_percent, "a rule that ends the search when the battery is below this")
      .between(own_search::kBattery_percent.lowest, own_search::kBattery_percent.highest);
  line.option("--battery-percent-per-km", &s.battery_percent_per_km,
              "what a kilometre through the water takes of your vehicle's battery, at search speed; without it the mission leaves it open")
      .between(own_search::kBattery_percent_per_km.lowest, own_search::kBattery_percent_per_km.highest);
  line.at("--battery-percent-per-km").needs(line.at("--battery-percent"));
  line.option("--fence-m", &s.fence_m,
              "a fence so far outside of the area: the vehicle is steered back from twice, and the mission aborted at four times that")
      .between(own_search::kFence_m.lowest, own_search::kFence_m.highest);
  line.flag("--own-tables", &s.own_tables,
            "believe in oceans of your own: README.md there explains how earshot tables makes tables of them");
  line.flag("--force", &o.force,
            "replace a folder that earshot init made, with what was changed in it; its key, tables, flights and journals stay");
}

/// What the chosen bus would leave without effect.
void require_used(const program::CommandLine& line, const std::string& bus) {
  const std::vector<std::string> given = line.given();
  const auto is_given = [&given](const char* name) { return std::ranges::find(given, name) != given.end(); };
  if (bus == "lcm" && is_given("--can-interface")) throw host::BadInput("--can-interface: needs --bus can, or mixed");
  if (bus == "can" && is_given("--lcm-url")) throw host::BadInput("--lcm-url: needs --bus lcm, or mixed");
}

/// A command in a line for each of its options, as a shell takes it, too.
std::string in_lines(std::string command) {
  constexpr std::string_view kBreak = " \\\n    ";
  for (const char* option : {" -o ", " --key ", " --vehicle-depth-m "}) {
    if (const std::size_t at = command.rfind(option); at != std::string::npos) command.replace(at, 1, kBreak);
  }
  return "  " + command;
}

void run(const program::CommandLine& line, const Options& o) {
  require_used(line, o.search.bus);
  using own_search::Earlier;
  using own_search::FliesBy;
  const FliesBy by = own_search::make_own_folder(o.folder, o.search, o.force ? Earlier::kReplaced : Earlier::kStays);
  if (by == FliesBy::kTablesToBeMade) {
    if (!o.search.own_tables) program::print() << "no ocean tables that ship are of this depth, frequency and area\n";
    program::print() << "to be made first:\n"
                     << in_lines(own_search::tables_command(o.search, fs::absolute(o.folder).lexically_normal())) << "\n";
  }
  if (o.search.battery_percent && !o.search.battery_percent_per_km)
    program::print() << "how far the battery lasts is left open: put your vehicle's battery_percent_per_km into\n"
                     << (o.folder / own_search::kMissionFile).string() << " (or --battery-percent-per-km)\n";
  program::print() << (o.folder / own_search::kReadmeFile).string() << " explains how to check this search and fly it\n";
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot init",
                            "Makes a folder for a search of your own: a mission, an ocean, a run file, all commented, and a README.");
  line.footer(
      "The ocean tables that ship are of 20 Hz, 27 to 363 m deep, and of 35 Hz at 30, 100 and 300 m (each within a tenth), as far as 35.4 "
      "km. For\n"
      "another search, and with --own-tables, README.md in DIR gives the command with which tables are made.\n"
      "Example: earshot init my_search --latitude-deg 47.5 --longitude-deg -8 --depth-m 200 --speed-mps 1.5");
  Options options;
  add_options(line, options);
  return command_line::run(line, argc, argv, [&] { run(line, options); });
}
