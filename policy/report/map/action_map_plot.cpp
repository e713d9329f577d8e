#include "policy/report/map/action_map_plot.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "policy/report/map/kilometres.hpp"
#include "policy/report/map/snr_surface.hpp"
#include "sim/plot/gnuplot.hpp"
#include "sim/plot/snr_scale.hpp"

namespace earshot::report {
namespace {

using explain::FlownPath;

constexpr const char* kArrowsInWords =
    "Arrow: the mean of the directions, each weighted by its probability; the shorter, the less they agree. Star: the source.";

std::string block(const std::string& name, const std::string& rows) {
  return "$" + name + " << EOD\n" + rows + "EOD\n";
}

Rectangle area_of(const MapOcean& ocean) {
  return {.south_west = {}, .north_east = ocean.policy.area_size};
}

/// Arrows about their places, so that none leans on its neighbour: at most nine tenths of a cell long.
std::string arrow_rows(const policy::FrozenPolicy& policy, const explain::ActionMap& arrows) {
  const double per_side = std::sqrt(static_cast<double>(arrows.size()));
  const Meters longest = 0.9 / per_side * std::min(policy.area_size.north, policy.area_size.east);
  std::ostringstream rows;
  for (const explain::MapPoint& point : arrows) {
    const NorthEast arrow = (std::max(point.agreement, 0.15) * longest) * point.heading;
    rows << km(point.place - NorthEast{arrow.north / 2.0, arrow.east / 2.0}) << ' ' << km(arrow) << '\n';
  }
  return rows.str();
}

std::string probability_rows(const explain::ActionMap& arrows) {
  std::ostringstream rows;
  for (const explain::MapPoint& point : arrows) rows << km(point.place) << ' ' << point.probabilities[point.likeliest] << '\n';
  return rows.str();
}

std::string belief_rows(const explain::DecisionAccount& account) {
  const explain::BelievedPlace& place = account.place;
  std::ostringstream rows;
  for (std::size_t i = 0; i < place.cells_north; ++i) {
    for (std::size_t j = 0; j < place.cells_east; ++j)
      rows << km(place.centre(i, j)) << ' ' << 1.0 - place.rank[i * place.cells_east + j] << '\n';
    rows << '\n';
  }
  return rows.str();
}

std::string track_rows(const MapFlight& flight) {
  std::ostringstream rows;
  for (const explain::RecordedDecision& measurement : flight.track)
    rows << km(measurement.position - flight.belief.area.south_west) << '\n';
  return rows.str();
}

/// Every path with the number of its steps, a blank line between two.
std::string path_rows(std::span<const FlownPath> paths) {
  std::ostringstream rows;
  for (const FlownPath& path : paths) {
    for (const NorthEast place : path.places) rows << km(place) << ' ' << path.steps() << '\n';
    rows << '\n';
  }
  return rows.str();
}

std::string start_rows(std::span<const FlownPath> paths) {
  std::ostringstream rows;
  for (const FlownPath& path : paths)
    rows << km(path.places.front()) << ' ' << path.steps() << ' ' << (path.end == FlownPath::End::kFound ? 1 : 0) << '\n';
  return rows.str();
}

/// Margins in shares of the picture, so that both panels are squares of one height whatever stands beside them.
std::string panel(double left, double right, const std::string& title) {
  std::ostringstream text;
  text << "set lmargin at screen " << left << "\nset rmargin at screen " << right << "\nset title " << plot::quoted(title)
       << " noenhanced\n";
  return text.str();
}

/// What both pictures have in common: heading, the SNR on the left, a sentence below. `right_panel` draws the rest.
void draw_beside_snr(const std::filesystem::path& path, const MapOcean& ocean, const std::string& blocks, const std::string& right_panel,
                     const std::string& sentence, bool has_track) {
  constexpr std::size_t kCellsPerSide = 250;
  const std::string heading = "What " + ocean.policy_name + " does: " + ocean.conditions;
  std::string text = blocks + block("snr", snr_rows(ocean.curve, ocean.heard_from, area_of(ocean), kCellsPerSide));
  if (ocean.source) text += block("source", km(*ocean.source) + "\n");
  text += "set multiplot title " + plot::quoted(heading) + " noenhanced font ',15'\nset label 1 " + plot::quoted(sentence) +
          " at screen 0.5,0.035 center noenhanced\n" + km_ranges(area_of(ocean)) +
          "set xlabel 'east (km)'\nset ylabel 'north (km)'\nset size ratio -1\nset tics out\nunset key\nset bmargin at screen 0.165\nset "
          "tmargin "
          "at screen 0.865\n" +
          panel(0.05, 0.40, ocean.words) + plot::snr_scale(ocean.policy.detection_threshold) + "plot $snr with image" +
          (has_track ? ", $track with linespoints pt 7 ps 0.6 lw 1.6 lc rgb 'black'" : "") +
          (ocean.source ? ", $source with points pt 3 ps 1.8 lw 2 lc rgb 'black'" : "") + "\nunset label 1\n" + right_panel +
          "unset multiplot\n";
  plot::draw(path, {.title = heading, .size = "1560,780", .commands = text});
}

std::string count(const char* what, std::size_t paths) {
  return paths == 0 ? "" : std::string("; ") + what + std::to_string(paths);
}

}  // namespace

void draw_arrows(const std::filesystem::path& path, const MapOcean& ocean, const explain::ActionMap& arrows, const std::string& words,
                 const std::optional<MapFlight>& flight) {
  const std::string blocks = block("arrows", arrow_rows(ocean.policy, arrows)) +
                             (flight ? block("belief", belief_rows(flight->belief)) + block("track", track_rows(*flight))
                                     : block("probability", probability_rows(arrows)));
  std::string text = panel(0.555, 0.905, words) + "set cbrange [0:1]\nset cbtics 0.2\n";
  text += flight ? "set cblabel 'believed: 1 where the source is likeliest'\n"
                   "set palette defined (0 '#ffffff', 0.05 '#fdf2e3', 0.5 '#e9a15b', 1 '#b3541e')\nplot $belief with image"
                 : "set cblabel 'probability of the likeliest direction'\n"
                   "set palette defined (0 '#ffffff', 1 '#7fb8dd')\nplot $probability with image";
  text += ", $arrows using 1:2:3:4 with vectors filled head size 0.35,20,60 lw 1.1 lc rgb '#1d2733'";
  if (flight) text += ", $track with linespoints pt 7 ps 0.6 lw 1.6 lc rgb '#c2127a'";
  if (ocean.source) text += ", $source with points pt 3 ps 1.8 lw 2 lc rgb 'black'";
  draw_beside_snr(path, ocean, blocks, text + "\n", std::string(kArrowsInWords) + (flight ? " Dots: where the vehicle has been." : ""),
                  flight.has_value());
}

void draw_paths(const std::filesystem::path& path, const MapOcean& ocean, std::span<const FlownPath> paths) {
  const auto longest = std::ranges::max_element(paths, {}, &FlownPath::steps);
  std::ostringstream text;
  text << panel(0.555, 0.905, "where it goes without random fluctuation of the SNR, by its best direction at every step")
       << "set cblabel 'steps of the path'\n"
       << "set cbrange [0:" << longest->steps() << "]\nset cbtics autofreq\n"
       << "set palette defined (0 '#1d5c8a', 0.5 '#8a5aa8', 1 '#d1495b')\n"
       << "plot $snr using 1:2:($3>=" << ocean.policy.detection_threshold.value
       << "?226:255):($3>=" << ocean.policy.detection_threshold.value << "?236:255):($3>=" << ocean.policy.detection_threshold.value
       << "?244:255) with rgbimage, $paths using 1:2:3 with lines lw 1.8 lc palette, "
          "$starts using 1:($4==1?$2:1/0):3 with points pt 7 ps 1 lc palette, $starts using 1:($4==0?$2:1/0):3 with points pt 2 ps 1.4 lw "
          "3 lc "
          "palette, $source with points pt 3 ps 1.8 lw 2 lc rgb 'black'\n";
  draw_beside_snr(path, ocean, block("paths", path_rows(paths)) + block("starts", start_rows(paths)), text.str(),
                  paths_to_string(paths) + ". Dot: a start; cross: one from which it is not found. Pale: the source (star) is heard.",
                  false);
}

std::string paths_to_string(std::span<const FlownPath> paths) {
  std::vector<std::size_t> steps;
  std::size_t left = 0;
  for (const FlownPath& path : paths) {
    if (path.end == FlownPath::End::kFound) steps.push_back(path.steps());
    if (path.end == FlownPath::End::kLeft) ++left;
  }
  std::ranges::sort(steps);
  std::string text = "The source is found from " + std::to_string(steps.size()) + " of " + std::to_string(paths.size()) + " starts";
  if (!steps.empty())
    text += ", after " + std::to_string(steps.front()) + " to " + std::to_string(steps.back()) + " steps (median " +
            std::to_string(steps[steps.size() / 2]) + ")";
  return text + count("the area is left from ", left) + count("it is not found in time from ", paths.size() - steps.size() - left);
}

}  // namespace earshot::report
