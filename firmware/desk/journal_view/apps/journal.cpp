// earshot-journal: what happened on a mission, out of its journal; and the journal for other programs.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "firmware/desk/journal_view/view.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/program/run.hpp"

namespace {

using namespace earshot;

n2k::LocalPlane plane_about(const std::string& origin) {
  const std::size_t comma = origin.find(',');
  const auto refuse = [&](const char* why) -> host::BadInput { return host::BadInput("--origin " + origin + ": " + why); };
  if (comma == std::string::npos) throw refuse("must be LATITUDE_DEG,LONGITUDE_DEG");
  const std::optional<double> latitude_deg = program::finite_number(origin.substr(0, comma));
  const std::optional<double> longitude_deg = program::finite_number(origin.substr(comma + 1));
  if (!latitude_deg || !longitude_deg) throw refuse("must be two numbers, LATITUDE_DEG,LONGITUDE_DEG");
  const Result<n2k::LocalPlane> plane = n2k::LocalPlane::about({.latitude_deg = *latitude_deg, .longitude_deg = *longitude_deg});
  if (!plane.ok()) throw refuse("the latitude must be within 80 degrees of the equator, the longitude from -180 to 180");
  return plane.value();
}

/// Whether one of the files that are asked for has latitudes and longitudes.
bool has_places(const journal::ViewOptions& options) {
  for (std::size_t i = 0; i < journal::kExportKindCount; ++i)
    if (options.files[i] && journal::kExportKinds[i].origin != journal::Origin::kUnused) return true;
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot journal",
      "earshot journal JOURNAL prints what happened on a mission, a line each: orders, states, decisions, rules that act, links "
      "that\ngo down, and what the journal lacks. With an option such as --csv, --mcap or --gpx it writes files for other programs "
      "instead.\n"
      "Exit status: 0 all was read, 1 all that can be read was: the journal is damaged, lacks records or its end, which\n"
      "standard error reports, 2 it is no journal or a file was refused, 3 standard output is gone, 130 stopped while it followed.");
  journal::ViewOptions options;
  std::optional<std::string> origin;
  bool force = false;
  std::uint32_t wait_s = 60;
  line.option("JOURNAL", &options.journal, "journal of a flight (.lcmlog), its folder, or a log of its bus by lcm-logger").required();
  const program::Option follow = line.flag("--follow", &options.follow, "the mission is under way: print what happens until it ends");
  line.option("--wait", &wait_s, "with --follow: how many seconds to wait for a mission that begins there").from(1, 86'400).shows_default();
  for (std::size_t i = 0; i < journal::kExportKindCount; ++i)
    line.option(journal::kExportKinds[i].option, &options.files[i], journal::kExportKinds[i].help).excludes(follow);
  line.option("--origin", &origin,
              "LATITUDE_DEG,LONGITUDE_DEG of the mission's origin (its file's table [origin]), for latitudes and longitudes in the files; "
              "default: that in the summary.json of a simulated flight");
  line.flag("--force", &force, "replace a file that is there already, of whatever kind it is");
  line.footer(
      "Examples:\n"
      "  earshot journal out\n"
      "  earshot journal out/sea/journal.lcmlog --follow\n"
      "  earshot journal out/journal.lcmlog --mcap flight.mcap --origin 38.5,-20.1\n"
      "  earshot journal out --geojson flight.geojson --kml flight.kml");
  return program::run(line, argc, argv, [&] {
    if (origin && !has_places(options)) throw host::BadInput("--origin: only with a file that has latitudes and longitudes, such as --csv");
    if (origin) options.plane = plane_about(*origin);
    options.wait = std::chrono::seconds(wait_s);
    options.replace = host::replaced_by(force);
    return journal::view(options);
  });
}
