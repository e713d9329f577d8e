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

/// What a picture's axes show, in their units: logarithms where they are logarithmic.
struct Frame {
  double low_x = 0.0;
  double high_x = 0.0;
  double low_y = 0.0;
  double high_y = 0.0;
};

/// From no false alarm to the most.
Frame frame_of_recalls(const std::vector<Spot>& spots) {
  return {.high_x = (*std::ranges::max_element(spots, {}, &Spot::x)).x, .high_y = 1.02};
}

/// gnuplot's own choice: whole powers of ten.
Frame frame_of_misses(const std::vector<Spot>& logarithms) {
  const auto [least_x, most_x] = std::ranges::minmax_element(logarithms, {}, &Spot::x);
  return {.low_x = std::floor(least_x->x),
          .high_x = std::ceil(most_x->x),
          .low_y = std::floor((*std::ranges::min_element(logarithms, {}, &Spot::y)).y)};
}

/// Data of a picture's labels, and what is plotted of them.
struct Labels {
  std::string data;
  std::string plot;
};

/// Labels that lie on no other one: points of one place share theirs, and one that would lie on another's goes without. Those of points
/// near the right end, beside which there is no room, are a block of their own.
/// @param shown  the spots as they lie in the picture: logarithms where its axes are logarithmic
Labels labels(const char* name, const std::vector<Spot>& spots, const std::vector<Spot>& shown, const Frame& frame) {
  struct Label {
    std::size_t at;
    double to_db;
  };
  const double width = kLabelWidth * (frame.high_x - frame.low_x);
  const double height = kLabelHeight * (frame.high_y - frame.low_y);
  const auto is_at_end = [&](std::size_t i) { return frame.high_x - shown[i].x < width; };
  std::vector<Label> kept;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto lies_on = [&](const Label& label) {
      const double apart = is_at_end(i) == is_at_end(label.at) ? width : 2.0 * width;  // towards one another they need twice the room
      return std::abs(shown[i].x - shown[label.at].x) < apart && std::abs(shown[i].y - shown[label.at].y) < height;
    };
    const bool is_same = i > 0 && shown[i].x == shown[i - 1].x && shown[i].y == shown[i - 1].y;
    if (is_same && kept.back().to_db == shown[i - 1].threshold_db)
      kept.back().to_db = shown[i].threshold_db;
    else if (std::ranges::none_of(kept, lies_on))
      kept.push_back({.at = i, .to_db = shown[i].threshold_db});
  }
  std::ostringstream inner;
  std::ostringstream outer;
  for (const Label& label : kept) {
    const Spot& spot = spots[label.at];
    std::ostringstream& data = is_at_end(label.at) ? outer : inner;
    data << spot.x << ' ' << spot.y << " \"" << spot.threshold_db;
    if (label.to_db != spot.threshold_db) data << " to " << label.to_db;
    data << " dB\"\n";
  }
  const auto block_of = [](const std::string& block, const std::string& rows, const char* place) {
    if (rows.empty()) return Labels{};  // gnuplot refuses a block without a row
    return Labels{block + " << EOD\n" + rows + "EOD\n", ", " + block + " using 1:2:3 with labels font ',9' offset " + place};
  };
  const Labels begin = block_of(name, inner.str(), "1.6,-0.6 left");
  const Labels end = block_of(std::string(name) + "_at_end", outer.str(), "-1.6,-0.6 right");
  return {begin.data + end.data, begin.plot + end.plot};
}

std::vector<Spot> logarithms(std::vector<Spot> spots) {
  for (Spot& spot : spots) spot = {std::log10(spot.x), std::log10(spot.y), spot.threshold_db};
  return spots;
}

constexpr const char* kStyle =
    "set tics out nomirror\nset grid lc rgb '#dddddd'\nset key off\n"
    "set xlabel 'false alarms per hour'\n";

std::string curve(const std::string& points, const Labels& labels) {
  return "plot " + points + " using 1:2 with linespoints lc rgb '#a63603' lw 2 pt 7 ps 0.6" + labels.plot + "\n";
}

}  // namespace

void plot_operating_curve(const std::filesystem::path& path, const std::vector<annotation::OperatingPoint>& points,
                          const std::string& title, const std::string& subtitle) {
  const std::string head =
      "set title " + quoted(title) + ".\"\\n\"." + quoted(subtitle) + ".\"\\n\"." + quoted("labels: thresholds in dB") + " noenhanced\n";
  std::ostringstream text;
  const std::vector<Spot> found = recalls(points);
  const std::vector<Spot> missed = misses(points);
  const std::vector<Spot> missed_logarithms = logarithms(missed);
  const Labels of_found = labels("$recall_labels", found, found, frame_of_recalls(found));
  const Labels of_missed = labels("$miss_labels", missed, missed_logarithms, frame_of_misses(missed_logarithms));
  text << block("$recalls", found) << of_found.data << block("$misses", missed) << of_missed.data << kStyle << "set multiplot layout 1,2\n"
       << head << "set ylabel 'recall'\nset yrange [0:1.02]\nset xrange [0:*]\n"
       << curve("$recalls", of_found)
       << "set title 'Misses against false alarms (0 is drawn as 0.5 of a false alarm or call)'\nset ylabel 'share missed'\nset logscale "
          "xy\n"
          "set xrange [*:*]\nset yrange [*:1]\n"
       << curve("$misses", of_missed) << "unset multiplot\n";
  draw(path, {.title = title, .size = "1300,560", .commands = text.str()});
}

}  // namespace earshot::plot
