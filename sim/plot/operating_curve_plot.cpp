#include "sim/plot/operating_curve_plot.hpp"

#include <algorithm>
#include <sstream>

#include "sim/plot/gnuplot.hpp"

namespace earshot::plot {
namespace {

std::string table(const std::vector<annotation::OperatingPoint>& points) {
  std::ostringstream data;
  for (const annotation::OperatingPoint& point : points) {
    // A logarithm wants more than nothing: a half stands for none.
    const double hours = point.score.hours;
    const double misses = std::max(static_cast<double>(point.score.misses()), 0.5) / static_cast<double>(point.score.truths);
    const double alarms = std::max(static_cast<double>(point.score.false_alarms()), 0.5) / hours;
    data << point.score.false_alarms_per_hour() << ' ' << point.score.recall() << ' ' << alarms << ' ' << misses << ' '
         << point.threshold_db << '\n';
  }
  return data.str();
}

constexpr const char* kLook =
    "set tics out nomirror\nset grid lc rgb '#dddddd'\nset key off\n"
    "set xlabel 'false alarms per hour'\n";

std::string curve(const std::string& columns) {
  return "plot $points using " + columns + " with linespoints lc rgb '#a63603' lw 2 pt 7 ps 0.6, $points using " + columns +
         ":(sprintf('%g dB', $5)) every 3 with labels font ',9' offset 1.6,-0.6 left\n";
}

}  // namespace

void plot_operating_curve(const std::filesystem::path& path, const std::vector<annotation::OperatingPoint>& points,
                          const std::string& title, const std::string& subtitle) {
  const std::string head = "set title " + quoted(title) + ".\"\\n\"." + quoted(subtitle) + " noenhanced\n";
  std::ostringstream text;
  text << "$points << EOD\n"
       << table(points) << "EOD\n"
       << kLook << "set multiplot layout 1,2\n"
       << head << "set ylabel 'recall'\nset yrange [0:1.02]\nset xrange [0:*]\n"
       << curve("1:2")
       << "set title 'Misses against false alarms; one half stands for none'\nset ylabel 'share missed'\nset logscale xy\n"
          "set xrange [*:*]\nset yrange [*:1]\n"
       << curve("3:4") << "unset multiplot\n";
  draw(path, {.title = title, .size = "1300,560", .commands = text.str()});
}

}  // namespace earshot::plot
