#include "sim/plot/operating_curve_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "sim/plot/gnuplot.hpp"

namespace earshot::plot {
namespace {

/// Shares of a picture's width and height that a label takes.
constexpr double kLabelWidth = 0.14;
constexpr double kLabelHeight = 0.045;

/// A point in the units of a picture's axes.
struct Spot {
  double x = 0.0;
  double y = 0.0;
  double threshold_db = 0.0;
};

std::vector<Spot> recalls(const std::vector<annotation::OperatingPoint>& points) {
  std::vector<Spot> spots;
  for (const annotation::OperatingPoint& point : points)
    spots.push_back({point.score.false_alarms_per_hour(), point.score.recall(), point.threshold_db});
  return spots;
}

/// A logarithm wants more than nothing: a half stands for none.
std::vector<Spot> misses(const std::vector<annotation::OperatingPoint>& points) {
  std::vector<Spot> spots;
  for (const annotation::OperatingPoint& point : points)
    spots.push_back({std::max(static_cast<double>(point.score.false_alarms()), 0.5) / point.score.hours,
                     std::max(static_cast<double>(point.score.misses()), 0.5) / static_cast<double>(point.score.truths),
                     point.threshold_db});
  return spots;
}

std::string block(const char* name, const std::vector<Spot>& spots) {
  std::ostringstream data;
  data << name << " << EOD\n";
  for (const Spot& spot : spots) data << spot.x << ' ' << spot.y << '\n';
  data << "EOD\n";
  return data.str();
}

double extent(const std::vector<Spot>& spots, double Spot::*of) {
  const auto [least, most] = std::ranges::minmax_element(spots, {}, of);
  return std::max((*most).*of - (*least).*of, 1e-9);
}

/// Labels that lie on no other one: points of one place share theirs, and one that would lie on another's goes without.
/// @param shown  the spots as they lie in the picture: logarithms where its axes are logarithmic
std::string labels(const char* name, const std::vector<Spot>& spots, const std::vector<Spot>& shown) {
  struct Label {
    std::size_t at;
    double to_db;
  };
  const double width = kLabelWidth * extent(shown, &Spot::x);
  const double height = kLabelHeight * extent(shown, &Spot::y);
  std::vector<Label> kept;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto lies_on = [&](const Label& label) {
      return std::abs(shown[i].x - shown[label.at].x) < width && std::abs(shown[i].y - shown[label.at].y) < height;
    };
    const bool is_same = i > 0 && shown[i].x == shown[i - 1].x && shown[i].y == shown[i - 1].y;
    if (is_same && kept.back().to_db == shown[i - 1].threshold_db)
      kept.back().to_db = shown[i].threshold_db;
    else if (std::ranges::none_of(kept, lies_on))
      kept.push_back({.at = i, .to_db = shown[i].threshold_db});
  }
  std::ostringstream data;
  data << name << " << EOD\n";
  for (const Label& label : kept) {
    const Spot& spot = spots[label.at];
    data << spot.x << ' ' << spot.y << " \"" << spot.threshold_db;
    if (label.to_db != spot.threshold_db) data << " to " << label.to_db;
    data << " dB\"\n";
  }
  data << "EOD\n";
  return data.str();
}

std::vector<Spot> logarithms(std::vector<Spot> spots) {
  for (Spot& spot : spots) spot = {std::log10(spot.x), std::log10(spot.y), spot.threshold_db};
  return spots;
}

constexpr const char* kLook =
    "set tics out nomirror\nset grid lc rgb '#dddddd'\nset key off\n"
    "set xlabel 'false alarms per hour'\n";

std::string curve(const std::string& points, const std::string& labels) {
  return "plot " + points + " using 1:2 with linespoints lc rgb '#a63603' lw 2 pt 7 ps 0.6, " + labels +
         " using 1:2:3 with labels font ',9' offset 1.6,-0.6 left\n";
}

}  // namespace

void plot_operating_curve(const std::filesystem::path& path, const std::vector<annotation::OperatingPoint>& points,
                          const std::string& title, const std::string& subtitle) {
  const std::string head = "set title " + quoted(title) + ".\"\\n\"." + quoted(subtitle) + " noenhanced\n";
  std::ostringstream text;
  const std::vector<Spot> found = recalls(points);
  const std::vector<Spot> missed = misses(points);
  text << block("$recalls", found) << labels("$recall_labels", found, found) << block("$misses", missed)
       << labels("$miss_labels", missed, logarithms(missed)) << kLook << "set multiplot layout 1,2\n"
       << head << "set ylabel 'recall'\nset yrange [0:1.02]\nset xrange [0:*]\n"
       << curve("$recalls", "$recall_labels")
       << "set title 'Misses against false alarms; one half stands for none'\nset ylabel 'share missed'\nset logscale xy\n"
          "set xrange [*:*]\nset yrange [*:1]\n"
       << curve("$misses", "$miss_labels") << "unset multiplot\n";
  draw(path, {.title = title, .size = "1300,560", .commands = text.str()});
}

}  // namespace earshot::plot
