#include "policy/report/belief_pictures.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "policy/report/gnuplot/gnuplot_svg.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

/// 3 in the smallest area that holds half of the probability, 2 in that of 80 %, 1 in that of 95 %; nothing elsewhere.
const char* shade(double rank, double share) {
  if (rank - share < 0.5) return "3";
  if (rank - share < 0.8) return "2";
  return rank - share < 0.95 ? "1" : "NaN";
}

void write_belief(const fs::path& path, const explain::DecisionAccount& account) {
  const explain::BelievedPlace& place = account.place;
  std::ofstream out(path);
  for (std::size_t i = 0; i < place.cells_north; ++i) {
    for (std::size_t j = 0; j < place.cells_east; ++j) {
      const std::size_t cell = i * place.cells_east + j;
      out << km(account.area.south_west + place.centre(i, j)) << ' ' << shade(place.rank[cell], place.probability[cell]) << '\n';
    }
    out << '\n';
  }
}

void write_ellipse(const fs::path& path, const explain::DecisionAccount& account) {
  const explain::SpreadEllipse& ellipse = account.place.ellipse;
  const UnitNorthEast along{.north = std::cos(ellipse.bearing.value), .east = std::sin(ellipse.bearing.value)};
  const UnitNorthEast across{.north = -along.east, .east = along.north};
  std::ofstream out(path);
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * std::numbers::pi / 36.0;
    out << km(account.area.south_west + account.place.mean + (ellipse.semi_major * std::cos(angle)) * along +
              (ellipse.semi_minor * std::sin(angle)) * across)
        << '\n';
  }
}

void write_measurements_file(const fs::path& path, std::span<const explain::RecordedDecision> measurements) {
  std::ofstream out(path);
  for (const explain::RecordedDecision& measurement : measurements)
    out << km(measurement.position) << ' ' << (measurement.detected ? 1 : 0) << '\n';
}

/// The datasets stand in files of the folder, `name` their common beginning.
std::string plot_of(const PlotFolder& folder, const std::string& name, const BeliefPicture& picture) {
  const explain::DecisionAccount& account = picture.account;
  write_belief(folder / (name + ".belief"), account);
  write_ellipse(folder / (name + ".ellipse"), account);
  write_measurements_file(folder / (name + ".measured"), picture.measurements);
  std::ofstream(folder / (name + ".marks")) << km(account.area.south_west + account.place.likeliest) << "\n\n\n"
                                            << km(account.area.south_west + account.place.mean) << "\n\n\n"
                                            << km(account.decision.position) << ' '
                                            << km(account.decision.waypoint - account.decision.position) << "\n\n\n"
                                            << (picture.source ? km(*picture.source) : "") << '\n';
  const auto file = [&name](const char* suffix) { return "'" + name + suffix + "'"; };
  std::string text = "set output '" + name + ".svg'\n" + km_ranges(account.area);
  text += "plot " + file(".belief") + " using 1:2:3 with image pixels notitle, \\\n";
  text += " keyentry with points pt 5 ps 1.6 lc rgb '#b3541e' title '50 % area', \\\n";
  text += " keyentry with points pt 5 ps 1.6 lc rgb '#e9a15b' title '80 %', \\\n";
  text += " keyentry with points pt 5 ps 1.6 lc rgb '#f6dcb8' title '95 %', \\\n";
  text += file(".ellipse") + " using 1:2 with lines lw 1.8 dt (6,4) lc rgb '#2f7fc0' title 'one std. dev.', \\\n";
  text += file(".measured") + " using 1:2 with lines lw 2.4 lc rgb '#c2127a' title 'track', \\\n";
  text += file(".measured") + " using 1:2 with points pt 7 ps 0.72 lc rgb 'white' notitle, \\\n";
  text += file(".measured") + " using 1:($3==0?$2:1/0) with points pt 6 ps 0.6 lc rgb '#c2127a' title 'no detection', \\\n";
  text += file(".measured") + " using 1:($3==1?$2:1/0) with points pt 7 ps 0.72 lc rgb '#c2127a' title 'detection', \\\n";
  text += file(".marks") + " index 2 using 1:2:3:4 with vectors filled head size screen 0.018,20,60 lw 2.6 lc rgb 'black' notitle, \\\n";
  text += std::string(" keyentry with vectors filled head size screen 0.018,20,60 lw 2.6 lc ") + kInk + " title 'taken', \\\n";
  text += file(".marks") + " index 0 using 1:2 with points pt 1 ps 1.5 lc rgb '#2f7fc0' title 'likeliest', \\\n";
  text += file(".marks") + " index 1 using 1:2 with points pt 2 ps 1.2 lc rgb '#2f7fc0' title 'mean'";
  if (picture.source)
    text += ", \\\n" + file(".marks") +
            " index 3 using 1:2 with points pt 3 ps 1.3 lc rgb 'black' notitle, \\\n keyentry with points pt 3 ps 1.3 lc " + kInk +
            " title 'true source'";
  return text + "\n";
}

}  // namespace

std::vector<std::string> belief_svgs(const std::vector<BeliefPicture>& pictures) {
  if (pictures.empty()) return {};
  const PlotFolder folder;
  std::string script = page_style("600,760") + R"(
set size ratio -1
set lmargin at screen 0.11
set rmargin at screen 0.97
set bmargin at screen 0.307
set tmargin at screen 0.986
set xlabel 'east (km)'
set ylabel 'north (km)' offset 1,0
set cbrange [1:3]
set palette defined (1 '#f6dcb8', 2 '#e9a15b', 3 '#b3541e')
unset colorbox
set key at screen 0.53,0.215 center top vertical maxrows 4
set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb 'white' fillstyle solid noborder
)";
  std::vector<SvgOutput> outputs;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::string name = "belief" + std::to_string(i);
    script += plot_of(folder, name, pictures[i]);
    outputs.push_back({.file = name + ".svg",
                       .title = "Where the source is believed to be at step " + std::to_string(pictures[i].account.decision.step)});
  }
  return svgs_from(folder, script, outputs);
}

}  // namespace earshot::report
