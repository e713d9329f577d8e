#include "policy/report/plots.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "policy/report/gnuplot/gnuplot_svg.hpp"
#include "policy/report/snr_surface.hpp"
#include "sim/plot/snr_scale.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

std::string svg_from(const PlotFolder& folder, const std::string& title, const std::string& script) {
  return svgs_from(folder, script, {{.file = "plot.svg", .title = title}}).front();
}

sonar::SnrCurve curve_of(const Flight& flight) {
  std::vector<float> snr_db;
  for (const SnrRow& row : flight.snr) snr_db.push_back(static_cast<float>(row.snr_db));
  return {Meters{flight.snr.at(1).range_m}, std::move(snr_db)};
}

Rectangle area_of(const Flight& flight) {
  const auto& area = flight.summary.at("area");
  return {place_in(area.at("south_west")), place_in(area.at("north_east"))};
}

Decibels threshold_of(const Flight& flight) {
  return Decibels{flight.summary.at("detection_threshold_db").get<double>()};
}

/// At most some 4000 rows: a picture has no more points across.
std::size_t stride_of(const Flight& flight) {
  return flight.track.size() / 4000 + 1;
}

void write_track(const fs::path& path, const Flight& flight) {
  std::ofstream out(path);
  const std::size_t stride = stride_of(flight);
  for (std::size_t i = 0; i < flight.track.size(); ++i) {
    if (i % stride != 0 && i + 1 != flight.track.size()) continue;
    const TrackRow& row = flight.track[i];
    out << row.east_m / 1e3 << ' ' << row.north_m / 1e3 << ' ' << row.time_s / 3600 << ' ' << row.snr_db << ' ' << row.range_m / 1e3
        << '\n';
  }
}

void write_decisions(const fs::path& path, const Flight& flight) {
  std::ofstream out(path);
  for (const explain::RecordedDecision& d : flight.journal.decisions) {
    out << d.position.east.value / 1e3 << ' ' << d.position.north.value / 1e3 << ' ' << (d.detected ? 1 : 0) << ' ' << d.time_s() / 3600
        << ' ' << d.snr.value << '\n';
  }
}

void write_marks(const fs::path& path, const Flight& flight) {
  std::ofstream(path) << km(place_in(flight.summary.at("start"))) << "\n\n\n" << km(place_in(flight.summary.at("source"))) << '\n';
}

/// The vehicle's things are of one colour on every picture: a decision is filled where the source was heard and hollow where it was not.
/// White lies under them, so that they stand out on any colour of the map, as they do from the legend on any page.
constexpr const char* kMapPlot = R"('field.dat' using 1:2:3 with image notitle, \
 'track.dat' using 1:2 with lines lw 5 lc rgb 'white' notitle, \
 'track.dat' using 1:2 with lines lw 2.4 lc rgb '#c2127a' title 'track', \
 'decisions.dat' using 1:2 with points pt 7 ps 0.95 lc rgb 'white' notitle, \
 'decisions.dat' using 1:($3==0?$2:1/0) with points pt 6 ps 0.65 lc rgb '#c2127a' title 'decision, no detection', \
 'decisions.dat' using 1:($3==1?$2:1/0) with points pt 7 ps 0.72 lc rgb '#c2127a' title 'decision, detection', \
 'marks.dat' index 0 using 1:2 with points pt 5 ps 1.4 lc rgb 'white' notitle, \
 'marks.dat' index 0 using 1:2 with points pt 5 ps 1.0 lc rgb '#c2127a' title 'start', \
 'marks.dat' index 1 using 1:2 with points pt 7 ps 1.9 lc rgb 'white' notitle, \
 'marks.dat' index 1 using 1:2 with points pt 3 ps 1.3 lc rgb 'black' notitle, \
 keyentry with points pt 3 ps 1.3 lc )";

/// A panel between two heights of the picture, so that the axes of two panels stand over one another.
std::string panel(double bottom, double top) {
  std::ostringstream text;
  text << "set bmargin at screen " << bottom << "\nset tmargin at screen " << top << '\n';
  return text.str();
}

/// A handful along an axis from 0 to the longest range.
std::string km_between_tics(const Flight& flight) {
  double longest_km = 0.0;
  for (const TrackRow& row : flight.track) longest_km = std::max(longest_km, row.range_m / 1e3);
  double step_km = 5.0;
  while (longest_km > 4.0 * step_km) step_km *= 2.0;
  return std::to_string(step_km);
}

}  // namespace

std::string map_svg(const Flight& flight) {
  constexpr std::size_t kCellsPerSide = 300;
  const PlotFolder scratch;
  const Rectangle area = area_of(flight);
  std::ofstream(scratch / "field.dat") << snr_rows(curve_of(flight), place_in(flight.summary.at("source")), area, kCellsPerSide);
  write_track(scratch / "track.dat", flight);
  write_decisions(scratch / "decisions.dat", flight);
  write_marks(scratch / "marks.dat", flight);
  return svg_from(scratch, "SNR at the vehicle's depth and the vehicle's track",
                  page_style("600,770") + plot::snr_scale(threshold_of(flight)) + km_ranges(area) + panel(0.203, 0.873) + R"(
set output 'plot.svg'
set size ratio -1
set lmargin at screen 0.11
set rmargin at screen 0.97
set colorbox horizontal user origin 0.11,0.955 size 0.86,0.02
set cblabel offset 0,0.9
set xlabel 'east (km)'
set ylabel 'north (km)' offset 1,0
set key at screen 0.53,0.11 center top vertical maxrows 3
plot )" + kMapPlot + kInk +
                      " title 'source'\n");
}

std::string history_svg(const Flight& flight) {
  const PlotFolder scratch;
  write_track(scratch / "track.dat", flight);
  write_decisions(scratch / "decisions.dat", flight);
  const std::string threshold = std::to_string(threshold_of(flight).value);
  return svg_from(scratch, "SNR heard and range to the source against time",
                  page_style("600,560") + R"(
set output 'plot.svg'
set multiplot
set lmargin at screen 0.11
set rmargin at screen 0.97
set ylabel 'SNR (dB)' offset 1,0
set format x ''
set key at screen 0.53,0.99 center top vertical maxrows 2
set autoscale xfix
)" + panel(0.41, 0.89) +
                      "plot 'track.dat' using 3:4 with lines lw 1.8 lc rgb '#3f8fc5' title '" +
                      (flight.sound.is_there() ? "SNR, modelled" : "SNR") + "', \\\n" + threshold + " with lines lw 1.6 dt (6,4) lc " +
                      kInk + R"( title 'detection threshold', \
 'decisions.dat' using 4:($3==0?$5:1/0) with points pt 6 ps 0.65 lw 2 lc rgb '#c2127a' title 'decision, no detection', \
 'decisions.dat' using 4:($3==1?$5:1/0) with points pt 7 ps 0.65 lc rgb '#c2127a' title 'decision, detection'
set ylabel 'range (km)'
set xlabel 'time (h)'
set format x '%g'
set yrange [0:*]
set ytics )" + km_between_tics(flight) +
                      R"(
unset key
)" + panel(0.14, 0.37) +
                      "plot 'track.dat' using 3:5 with lines lw 1.8 lc rgb '#c77d2b'\nunset multiplot\n");
}

}  // namespace earshot::report
