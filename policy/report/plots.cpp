#include "policy/report/plots.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "policy/report/gnuplot_svg.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

std::string svg_from(const PlotFolder& folder, const std::string& script) {
  return svgs_from(folder, script, {"plot.svg"}).front();
}

double snr_at(const std::vector<SnrRow>& curve, double range_m) {
  const auto above = std::lower_bound(curve.begin(), curve.end(), range_m, [](const SnrRow& row, double r) { return row.range_m < r; });
  return above == curve.end() ? curve.back().snr_db : above->snr_db;
}

struct Box {
  double south, west, north, east;
};

Box area_of(const Flight& flight) {
  const auto& area = flight.summary.at("area");
  return {area.at("south_west").at("north_m"), area.at("south_west").at("east_m"), area.at("north_east").at("north_m"),
          area.at("north_east").at("east_m")};
}

void write_field(const fs::path& path, const Flight& flight, const Box& box) {
  constexpr int kCells = 300;
  const double source_north = flight.summary.at("source").at("north_m");
  const double source_east = flight.summary.at("source").at("east_m");
  std::ofstream out(path);
  for (int i = 0; i < kCells; ++i) {
    const double north = box.south + (i + 0.5) / kCells * (box.north - box.south);
    for (int j = 0; j < kCells; ++j) {
      const double east = box.west + (j + 0.5) / kCells * (box.east - box.west);
      out << east / 1e3 << ' ' << north / 1e3 << ' ' << snr_at(flight.snr, std::hypot(north - source_north, east - source_east)) << '\n';
    }
    out << '\n';
  }
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
    out << d.position.east.value / 1e3 << ' ' << d.position.north.value / 1e3 << ' ' << (d.detected ? 1 : 0) << ' ' << d.time_s / 3600
        << ' ' << d.heard.snr.value << '\n';
  }
}

std::string point(const nlohmann::json& place) {
  return std::to_string(place.at("east_m").get<double>() / 1e3) + ", " + std::to_string(place.at("north_m").get<double>() / 1e3);
}

}  // namespace

std::string map_svg(const Flight& flight) {
  const PlotFolder scratch;
  const Box box = area_of(flight);
  write_field(scratch / "field.dat", flight, box);
  write_track(scratch / "track.dat", flight);
  write_decisions(scratch / "decisions.dat", flight);
  const std::string threshold = std::to_string(flight.summary.at("detection_threshold_db").get<double>());
  const std::string ranges = "[" + std::to_string(box.west / 1e3) + ":" + std::to_string(box.east / 1e3) + "] [" +
                             std::to_string(box.south / 1e3) + ":" + std::to_string(box.north / 1e3) + "] ";
  return svg_from(scratch, std::string("set terminal svg size 900,800 dynamic enhanced font 'sans-serif,14'\n") + kPlotStyle +
                               "set output 'plot.svg'\n" + R"(
set size ratio -1
set xlabel 'east (km)'
set ylabel 'north (km)'
set cblabel 'SNR (dB)' textcolor rgb '#888888'
set cbtics textcolor rgb '#888888'
set cbrange [)" + threshold +
                               "-20:" + threshold + R"(+20]
set palette defined (0 '#0b2545', 0.35 '#1d5c8a', 0.4999 '#4f9cc0', 0.5 '#f2d48f', 0.7 '#e8a33d', 1 '#b5371c')
set key outside above center horizontal box lc rgb '#1d5c8a' opaque fillcolor rgb '#1d5c8a' textcolor rgb '#f2f6fa'
plot )" + ranges + R"('field.dat' using 1:2:3 with image notitle, \
 'track.dat' using 1:2 with lines lw 2.2 lc rgb '#ffffff' title 'track', \
 'decisions.dat' using 1:($3==0?$2:1/0) with points pt 6 ps 0.55 lw 1.4 lc rgb '#d0d0d0' title 'decision, nothing heard', \
 'decisions.dat' using 1:($3==1?$2:1/0) with points pt 7 ps 0.55 lc rgb '#2ee6a6' title 'decision, source heard', \
 '-' using 1:2 with points pt 5 ps 0.9 lc rgb '#ff4fd8' title 'start', \
 '-' using 1:2 with points pt 3 ps 1.5 lw 2.5 lc rgb '#ffffff' title 'source'
)" + point(flight.summary.at("start")) +
                               "\ne\n" + point(flight.summary.at("source")) + "\ne\n");
}

std::string history_svg(const Flight& flight) {
  const PlotFolder scratch;
  write_track(scratch / "track.dat", flight);
  write_decisions(scratch / "decisions.dat", flight);
  const std::string threshold = std::to_string(flight.summary.at("detection_threshold_db").get<double>());
  return svg_from(scratch, std::string("set terminal svg size 900,360 dynamic enhanced font 'sans-serif,14'\n") + kPlotStyle +
                               "set output 'plot.svg'\n" + R"(
set xlabel 'time (h)'
set ylabel 'SNR (dB)'
set y2label 'range to the source (km)'
set ytics nomirror
set y2tics textcolor rgb '#888888'
set y2range [0:*]
set key outside above center horizontal
plot 'track.dat' using 3:5 axes x1y2 with lines lw 1.6 dt 2 lc rgb '#c77d2b' title 'range', \
 'track.dat' using 3:4 with lines lw 1.8 lc rgb '#3f8fc5' title 'SNR', \
 'decisions.dat' using 4:5 with points pt 7 ps 0.5 lc rgb '#3f8fc5' title 'decision', \
 )" + threshold + " with lines lw 1.4 dt 3 lc rgb '#3aa876' title 'detection threshold'\n");
}

}  // namespace earshot::report
