#include "policy/report/action_map_plot.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "policy/report/gnuplot_svg.hpp"
#include "sim/sonar/gnuplot.hpp"

namespace earshot::report {
namespace {

std::string block(const std::string& name, const std::string& rows) {
  return "$" + name + " << EOD\n" + rows + "EOD\n";
}

std::string snr_rows(const ActionMapPicture& picture) {
  constexpr std::size_t kPerSide = 200;
  const auto along = [](Meters side, std::size_t i) { return side * ((static_cast<double>(i) + 0.5) / double{kPerSide}); };
  std::ostringstream rows;
  for (std::size_t i = 0; i < kPerSide; ++i) {
    for (std::size_t j = 0; j < kPerSide; ++j) {
      const NorthEast place{along(picture.policy.area_size.north, i), along(picture.policy.area_size.east, j)};
      rows << km(place) << ' ' << picture.snr_db(place) << '\n';
    }
    rows << '\n';
  }
  return rows.str();
}

/// Arrows about their places, so that none leans on its neighbour: at most nine tenths of a cell long.
std::string arrow_rows(const ActionMapPicture& picture) {
  const double per_side = std::sqrt(static_cast<double>(picture.map.size()));
  const Meters longest = 0.9 / per_side * std::min(picture.policy.area_size.north, picture.policy.area_size.east);
  std::ostringstream rows;
  for (const explain::MapPoint& point : picture.map) {
    const NorthEast arrow = (std::max(point.agreement, 0.15) * longest) * point.heading;
    rows << km(point.place - NorthEast{arrow.north / 2.0, arrow.east / 2.0}) << ' ' << km(arrow) << '\n';
  }
  return rows.str();
}

std::string probability_rows(const ActionMapPicture& picture) {
  std::ostringstream rows;
  for (const explain::MapPoint& point : picture.map) rows << km(point.place) << ' ' << point.probabilities[point.likeliest] << '\n';
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

std::string track_rows(const ActionMapPicture& picture) {
  std::ostringstream rows;
  for (const explain::RecordedDecision& look : picture.track) rows << km(look.position - picture.belief->area.south_west) << '\n';
  return rows.str();
}

std::string panel_style(const ActionMapPicture& picture) {
  std::ostringstream text;
  text << "set xrange [0:" << picture.policy.area_size.east.value / 1e3 << "]\nset yrange [0:" << picture.policy.area_size.north.value / 1e3
       << "]\nset xlabel 'east (km)'\nset ylabel 'north (km)'\nset size ratio -1\nset tics out\nunset key\n";
  return text.str();
}

/// Cold below the detection threshold and warm above it.
std::string snr_panel(const ActionMapPicture& picture) {
  const double threshold = picture.policy.detection_threshold.value;
  std::ostringstream text;
  text << "set title " << sonar::quoted(picture.heard) << " noenhanced\nset cblabel 'SNR (dB)'\nset cbrange [" << threshold - 20.0 << ':'
       << threshold + 20.0 << "]\nset palette defined (0 '#081d58', 20 '#a6cee3', 20 '#fee391', 40 '#cc4c02')\n"
       << "plot $snr with image" << (picture.source ? ", $source with points pt 3 ps 1.8 lw 2 lc rgb 'black'" : "")
       << (picture.belief ? ", $track with linespoints pt 7 ps 0.6 lw 1.6 lc rgb 'black'" : "") << '\n';
  return text.str();
}

std::string action_panel(const ActionMapPicture& picture) {
  std::string text = "set title " + sonar::quoted(picture.what) + " noenhanced\n";
  text += picture.belief ? "set cblabel 'believed: 1 where the source is likeliest'\nset cbrange [0:1]\n"
                           "set palette defined (0 '#ffffff', 0.05 '#fdf2e3', 0.5 '#e9a15b', 1 '#b3541e')\nplot $belief with image"
                         : "set cblabel 'probability of the likeliest direction'\nset cbrange [0:1]\n"
                           "set palette defined (0 '#ffffff', 1 '#7fb8dd')\nplot $probability with image";
  text += ", $arrows using 1:2:3:4 with vectors filled head size 0.35,20,60 lw 1.1 lc rgb '#1d2733'";
  if (picture.belief) text += ", $track with linespoints pt 7 ps 0.6 lw 1.6 lc rgb '#3f8fc5'";
  if (picture.source) text += ", $source with points pt 3 ps 1.8 lw 2 lc rgb '#d1126b'";
  return text + "\n";
}

}  // namespace

void draw_action_map(const std::filesystem::path& path, const ActionMapPicture& picture) {
  std::string text = block("snr", snr_rows(picture)) + block("arrows", arrow_rows(picture));
  if (picture.source) text += block("source", km(*picture.source) + "\n");
  text += picture.belief ? block("belief", belief_rows(*picture.belief)) + block("track", track_rows(picture))
                         : block("probability", probability_rows(picture));
  sonar::draw(
      path, "1560,700",
      text + "set multiplot layout 1,2\n" + panel_style(picture) + snr_panel(picture) + action_panel(picture) + "unset multiplot\n");
}

}  // namespace earshot::report
