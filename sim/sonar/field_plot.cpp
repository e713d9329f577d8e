#include "sim/sonar/field_plot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "sim/sonar/gnuplot.hpp"

namespace earshot::sonar {
namespace {

/// At most this many points along either axis: more than a picture shows only makes it slow.
constexpr std::size_t kMaxPoints = 500;

std::string value(float x) {
  if (std::isnan(x)) return "NaN";
  std::ostringstream text;
  text << x;
  return text.str();
}

std::string surface(const SonarField& field) {
  const std::size_t range_stride = std::max<std::size_t>(1, field.range_m.size() / kMaxPoints);
  const std::size_t depth_stride = std::max<std::size_t>(1, field.depth_m.size() / kMaxPoints);
  std::ostringstream data;
  for (std::size_t i = 0; i < field.range_m.size(); i += range_stride) {
    for (std::size_t j = 0; j < field.depth_m.size(); j += depth_stride) {
      data << field.range_m[i] / 1000.0 << ' ' << field.depth_m[j] << ' '
           << value(field.snr_db(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))) << '\n';
    }
  }
  return data.str();
}

/// Cold below the threshold and warm above it, so that the colour change is the edge of detection.
std::string snr_colours(Decibels detection_threshold) {
  std::ostringstream text;
  text << "set cblabel 'SNR (dB)'\nset cbrange [" << detection_threshold.value - 20.0 << ':' << detection_threshold.value + 20.0 << "]\n"
       << "set palette defined (0 '#081d58', 20 '#a6cee3', 20 '#fee391', 40 '#cc4c02')\n";
  return text.str();
}

/// The furthest detection range of every bearing as a closed line.
std::string ring(const Fan& fan, const Detector& detector) {
  const std::vector<DetectionRange> ranges = detection_ranges(fan, 0, detector);
  std::ostringstream data;
  for (std::size_t j = 0; j <= fan.bearings; ++j) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(j) / static_cast<double>(fan.bearings);
    const double range_m = ranges[j % fan.bearings].furthest_m;
    data << (fan.centre.east.value + range_m * std::sin(angle)) / 1000.0 << ' '
         << (fan.centre.north.value + range_m * std::cos(angle)) / 1000.0 << '\n';
  }
  return data.str();
}

std::string plane(const HorizontalMap& map, const std::vector<float>& values) {
  std::ostringstream data;
  for (std::size_t i = 0; i < map.north_m.size(); ++i) {
    for (std::size_t j = 0; j < map.east_m.size(); ++j)
      data << map.east_m[j] / 1000.0 << ' ' << map.north_m[i] / 1000.0 << ' ' << value(values[i * map.east_m.size() + j]) << '\n';
  }
  return data.str();
}

}  // namespace

void plot_field(const std::filesystem::path& path, const SonarField& field, const std::string& title, Decibels detection_threshold) {
  std::ostringstream text;
  text << "set title " << quoted(title) << " noenhanced\nset xlabel 'range (km)'\nset ylabel 'depth (m)'\nset yrange [*:*] reverse\n"
       << snr_colours(detection_threshold) << "set autoscale fix\nset tics out\nunset key\n$field << EOD\n"
       << surface(field) << "EOD\nplot $field with image\n";
  draw(path, "1100,500", text.str());
}

void plot_map(const std::filesystem::path& path, const HorizontalMap& map, const Fan& fan, const std::string& title,
              const Detector& detector) {
  const bool two = detector.fluctuation.value > 0.0;
  const auto picture = [](const std::string& values) {
    return "plot $" + values + " with image, $ring with lines lc rgb 'black' lw 1.5, $source with points pt 3 ps 1.5 lc rgb 'black'\n";
  };
  std::ostringstream text;
  text << "$snr << EOD\n"
       << plane(map, map.snr_db) << "EOD\n$probability << EOD\n"
       << plane(map, map.detection_probability) << "EOD\n$ring << EOD\n"
       << ring(fan, detector) << "EOD\n$source << EOD\n"
       << fan.centre.east.value / 1000.0 << ' ' << fan.centre.north.value / 1000.0 << "\nEOD\n"
       << "set xlabel 'east (km)'\nset ylabel 'north (km)'\nset size ratio -1\nset autoscale fix\nset tics out\nunset key\n"
       << "set xrange [" << map.east_m.front() / 1000.0 << ':' << map.east_m.back() / 1000.0 << "]\nset yrange ["
       << map.north_m.front() / 1000.0 << ':' << map.north_m.back() / 1000.0 << "]\n"
       << (two ? "set multiplot layout 1,2\n" : "") << "set title " << quoted(title) << " noenhanced\n"
       << snr_colours(detector.detection_threshold) << picture("snr");
  if (two) {
    text << "set title 'probability of detection'\nset cblabel 'P_d'\nset cbrange [0:1]\n"
         << "set palette defined (0 '#081d58', 0.5 '#a6cee3', 0.5 '#fee391', 1 '#cc4c02')\n"
         << picture("probability") << "unset multiplot\n";
  }
  draw(path, two ? "1500,700" : "800,700", text.str());
}

}  // namespace earshot::sonar
