#include "policy/report/sea/sea_plots.hpp"

#include <algorithm>
#include <fstream>
#include <string_view>

#include "firmware/host/journal/words/wording.hpp"
#include "policy/report/gnuplot/gnuplot_svg.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPoints = 4000;  ///< a picture has no more across

void write_fixes(const fs::path& path, const SeaFlight& flight) {
  std::ofstream out(path);
  const std::size_t stride = flight.fixes.size() / kMostPoints + 1;
  for (std::size_t i = 0; i < flight.fixes.size(); ++i) {
    if (i % stride == 0 || i + 1 == flight.fixes.size()) out << km(flight.fixes[i].position) << '\n';
  }
}

/// @param unit_s  of the time axis
void write_decisions(const fs::path& path, const SeaFlight& flight, const std::vector<explain::RecordedDecision>& decisions,
                     double unit_s) {
  std::ofstream out(path);
  for (const explain::RecordedDecision& d : decisions)
    out << km(d.position) << ' ' << (d.detected ? 1 : 0) << ' ' << (d.time_s() - journal::seconds_of(flight.began)) / unit_s << ' '
        << d.snr.value << '\n';
}

/// The loudest of each group when there are more than the picture has points across: a call between two of them is not left out.
void write_heard(const fs::path& path, const SeaFlight& flight, double unit_s) {
  std::ofstream out(path);
  const std::size_t group = flight.measurements.size() / kMostPoints + 1;
  const auto is_fainter = [](const SeaFlight::Measurement& a, const SeaFlight::Measurement& b) { return a.snr_db < b.snr_db; };
  for (std::size_t i = 0; i < flight.measurements.size(); i += group) {
    const auto begin = flight.measurements.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = flight.measurements.begin() + static_cast<std::ptrdiff_t>(std::min(i + group, flight.measurements.size()));
    const SeaFlight::Measurement& loudest = *std::max_element(begin, end, is_fainter);
    out << loudest.time_s / unit_s << ' ' << loudest.snr_db << ' ' << (loudest.too_faint ? 1 : 0) << '\n';
  }
}

/// A square around the whole track, a tenth wider and 200 m at least.
Rectangle frame_of(const SeaFlight& flight) {
  NorthEast low = flight.fixes.front().position;
  NorthEast high = low;
  for (const SeaFlight::Fix& fix : flight.fixes) {
    low = {std::min(low.north, fix.position.north), std::min(low.east, fix.position.east)};
    high = {std::max(high.north, fix.position.north), std::max(high.east, fix.position.east)};
  }
  const NorthEast middle = {(low.north + high.north) / 2.0, (low.east + high.east) / 2.0};
  const NorthEast across = high - low;
  const Meters half = std::max(std::max(across.north, across.east) * 0.55, Meters{100.0});
  return Rectangle{middle, middle}.moved_in(half * -1.0);
}

void write_area(const fs::path& path, const Rectangle& area) {
  const auto& [low, high] = area;
  std::ofstream(path) << km(low) << '\n'
                      << km({high.north, low.east}) << '\n'
                      << km(high) << '\n'
                      << km({low.north, high.east}) << '\n'
                      << km(low) << '\n';
}

/// Of a time axis.
struct TimeUnit {
  double s;
  std::string name;
};

TimeUnit unit_for(double longest_s) {
  constexpr double kMinute_s = 60.0;
  constexpr double kHour_s = 3600.0;
  if (longest_s > 2.0 * kHour_s) return {.s = kHour_s, .name = "h"};
  return longest_s > 2.0 * kMinute_s ? TimeUnit{.s = kMinute_s, .name = "min"} : TimeUnit{.s = 1.0, .name = "s"};
}

/// Of the decisions' file: 1 east, 2 north, 3 whether the source was heard, 4 time, 5 SNR.
std::string decisions_plot(std::string_view x, std::string_view y) {
  const auto those = [&](const char* heard, const char* points) {
    return "'decisions.dat' using " + std::string(x) + ":($3==" + heard + "?$" + std::string(y) + ":1/0) with points " + points;
  };
  return those("0", "pt 6 ps 0.65 lw 2 lc rgb '#c2127a' title 'decision, no detection'") + ", \\\n" +
         those("1", "pt 7 ps 0.72 lc rgb '#c2127a' title 'decision, detection'");
}

}  // namespace

std::string sea_map_svg(const SeaFlight& flight, const std::vector<explain::RecordedDecision>& decisions) {
  if (flight.fixes.empty()) return "";
  const PlotFolder scratch;
  write_fixes(scratch / "track.dat", flight);
  write_area(scratch / "area.dat", flight.area);
  write_decisions(scratch / "decisions.dat", flight, decisions, 1.0);
  std::ofstream(scratch / "marks.dat") << km(flight.fixes.front().position) << "\n\n\n" << km(flight.fixes.back().position) << '\n';
  return svgs_from(scratch,
                   page_style("600,690") + km_ranges(frame_of(flight)) + R"(
set output 'plot.svg'
set size ratio -1
set lmargin at screen 0.17
set rmargin at screen 0.97
set bmargin at screen 0.22
set tmargin at screen 0.97
set xlabel 'east (km)'
set ylabel 'north (km)' offset 1,0
set key at screen 0.53,0.12 center top vertical maxrows 3
plot 'area.dat' using 1:2 with lines lw 1.6 dt (6,4) lc )" +
                       kInk + R"( title 'operating area', \
 'track.dat' using 1:2 with lines lw 2.4 lc rgb '#3f8fc5' title 'track', \
 )" + decisions_plot("1", "2") +
                       R"(, \
 'marks.dat' index 0 using 1:2 with points pt 5 ps 1.0 lc rgb '#c2127a' title 'first fix', \
 'marks.dat' index 1 using 1:2 with points pt 9 ps 1.2 lc rgb '#c2127a' title 'last fix'
)",
                   {{.file = "plot.svg", .title = "The vehicle's track by its own navigation"}})
      .front();
}

std::string sea_history_svg(const SeaFlight& flight, const std::vector<explain::RecordedDecision>& decisions) {
  if (flight.measurements.empty()) return "";
  const TimeUnit unit = unit_for(flight.ended_s);
  const PlotFolder scratch;
  write_heard(scratch / "heard.dat", flight, unit.s);
  write_decisions(scratch / "decisions.dat", flight, decisions, unit.s);
  return svgs_from(scratch,
                   page_style("600,400") + R"(
set output 'plot.svg'
set lmargin at screen 0.11
set rmargin at screen 0.97
set bmargin at screen 0.19
set tmargin at screen 0.77
set ylabel 'SNR (dB)' offset 1,0
set xlabel 'time since the journal began ()" +
                       unit.name + R"()'
set key at screen 0.53,0.98 center top vertical maxrows 3
set offsets graph 0, graph 0, graph 0.08, graph 0.08
plot 'heard.dat' using 1:($3==0?$2:1/0) with points pt 7 ps 0.3 lc rgb '#3f8fc5' title 'SNR that came in', \
 'heard.dat' using 1:($3==1?$2:1/0) with points pt 10 ps 0.4 lc rgb '#3f8fc5' title 'too faint: below this', \
 )" + std::to_string(flight.threshold.value) +
                       " with lines lw 1.6 dt (6,4) lc " + kInk + " title 'detection threshold', \\\n " + decisions_plot("4", "5") + "\n",
                   {{.file = "plot.svg", .title = "SNR against time"}})
      .front();
}

}  // namespace earshot::report
