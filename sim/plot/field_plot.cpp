#include "sim/plot/field_plot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "sim/plot/gnuplot.hpp"
#include "sim/plot/snr_scale.hpp"
#include "sim/sonar/horizontal_map.hpp"

namespace earshot::plot {
namespace {

/// At most this many points along either axis: more than a picture shows only makes it slow.
constexpr std::size_t kMaxPoints = 600;

std::size_t stride_of(std::size_t points) {
  return (points + kMaxPoints - 1) / kMaxPoints;
}

std::string value(double x) {
  if (std::isnan(x)) return "NaN";
  std::ostringstream text;
  text << x;
  return text.str();
}

std::string surface(const sonar::SonarField& field) {
  const std::size_t range_stride = stride_of(field.range_m.size());
  const std::size_t depth_stride = stride_of(field.depth_m.size());
  std::ostringstream data;
  for (std::size_t i = 0; i < field.range_m.size(); i += range_stride) {
    for (std::size_t j = 0; j < field.depth_m.size(); j += depth_stride) {
      data << field.range_m[i] / 1000.0 << ' ' << field.depth_m[j] << ' ' << value(static_cast<double>(field.snr_db(i, j))) << '\n';
    }
  }
  return data.str();
}

constexpr std::size_t kMostCurves = 8;

/// A block for each depth: range, transmission loss, SNR.
std::string curves(const sonar::SonarField& field) {
  const std::size_t stride = stride_of(field.range_m.size());
  std::ostringstream data;
  for (std::size_t j = 0; j < std::min(field.depth_m.size(), kMostCurves); ++j) {
    for (std::size_t i = 0; i < field.range_m.size(); i += stride) {
      const std::size_t at = i * field.depth_m.size() + j;
      data << field.range_m[i] / 1000.0 << ' ' << value(static_cast<double>(field.transmission_loss_db[at])) << ' '
           << value(static_cast<double>(field.snr_db(i, j))) << '\n';
    }
    data << "\n\n";
  }
  return data.str();
}

std::string curves_of(const sonar::SonarField& field, const char* column) {
  std::ostringstream text;
  text << "plot ";
  for (std::size_t j = 0; j < std::min(field.depth_m.size(), kMostCurves); ++j)
    text << (j == 0 ? "" : ", ") << "$curves index " << j << " using 1:" << column << " with "
         << (field.range_m.size() > 1 ? "lines" : "points") << " lw 1.5 lc " << j + 1 << " title 'hydrophone at " << field.depth_m[j]
         << " m'";
  return text.str();
}

std::string sea_floor(const sonar::SonarField& field) {
  const std::size_t stride = stride_of(field.range_m.size());
  std::ostringstream data;
  data << "0 " << field.sea_floor_depth_m.front() << '\n';
  for (std::size_t i = 0; i < field.range_m.size(); i += stride)
    data << field.range_m[i] / 1000.0 << ' ' << field.sea_floor_depth_m[i] << '\n';
  data << field.range_m.back() / 1000.0 << ' ' << field.sea_floor_depth_m.back() << '\n';
  return data.str();
}

constexpr const char* kProbabilityColours =
    "set cblabel 'probability of detection' offset 1,0\nset cbrange [0:1]\nset cbtics 0.2\n"
    "set palette defined (0 '#081d58', 0.5 '#bdd7e7', 0.5 '#fff3b0', 1 '#a63603')\n";

std::string sound_words(const ocean::Environment& environment, const ocean::Band& band) {
  std::ostringstream text;
  text << band.low.value;
  if (band.high > band.low) text << " to " << band.high.value;
  text << " Hz, source at " << environment.source.depth.value << " m, SL " << environment.source.level.value << " dB re 1 µPa @ 1 m, N "
       << std::round(10.0 * environment.noise_level.value) / 10.0 << " dB re 1 µPa";
  return text.str();
}

std::string title(const std::string& first, const std::string& second) {
  return "set title " + quoted(first) + ".\"\\n\"." + quoted(second) + " noenhanced\n";
}

/// One range of detection per bearing as a closed line; between bearings the range is linear, so that a circle looks like one.
std::string ring(const sonar::Fan& fan, const std::vector<sonar::DetectionRange>& ranges, double sonar::DetectionRange::*which) {
  constexpr std::size_t kParts = 16;
  std::ostringstream data;
  for (std::size_t part = 0; part <= fan.bearings * kParts; ++part) {
    const std::size_t j = part / kParts;
    const double fraction = static_cast<double>(part % kParts) / kParts;
    const double angle = sonar::bearing_of(part, fan.bearings * kParts).value;
    const double range_m = sonar::between(ranges[j % fan.bearings].*which, ranges[(j + 1) % fan.bearings].*which, fraction);
    data << value((fan.centre.east.value + range_m * std::sin(angle)) / 1000.0) << ' '
         << value((fan.centre.north.value + range_m * std::cos(angle)) / 1000.0) << '\n';
  }
  return data.str();
}

std::string plane(const sonar::HorizontalMap& map, const std::vector<float>& values) {
  std::ostringstream data;
  for (std::size_t i = 0; i < map.north_m.size(); ++i) {
    for (std::size_t j = 0; j < map.east_m.size(); ++j)
      data << map.east_m[j] / 1000.0 << ' ' << map.north_m[i] / 1000.0 << ' '
           << value(static_cast<double>(values[i * map.east_m.size() + j])) << '\n';
  }
  return data.str();
}

std::string map_data(const sonar::HorizontalMap& map, const sonar::Fan& fan, const sonar::Detector& detector) {
  const std::vector<sonar::DetectionRange> ranges = sonar::detection_ranges(fan, 0, detector);
  std::ostringstream text;
  text << "$snr << EOD\n"
       << plane(map, map.snr_db) << "EOD\n$probability << EOD\n"
       << plane(map, map.detection_probability) << "EOD\n$assured << EOD\n"
       << ring(fan, ranges, &sonar::DetectionRange::assured_m) << "EOD\n$furthest << EOD\n"
       << ring(fan, ranges, &sonar::DetectionRange::furthest_m) << "EOD\n$source << EOD\n"
       << fan.centre.east.value / 1000.0 << ' ' << fan.centre.north.value / 1000.0 << "\nEOD\n";
  return text.str();
}

std::string map_picture(const std::string& values) {
  return "plot $" + values +
         " with image notitle, $assured with lines lc rgb 'black' lw 2 title 'heard at every range within', "
         "$furthest with lines lc rgb 'black' lw 2 dt (6,4) title 'heard nowhere beyond', "
         "$source with points pt 3 ps 1.6 lw 2 lc rgb 'black' title 'source'\n";
}

}  // namespace

void plot_curves(const std::filesystem::path& path, const sonar::SonarField& field, const ocean::Environment& environment,
                 const ocean::Band& band, Radians bearing, Decibels detection_threshold) {
  std::ostringstream subtitle;
  subtitle << sound_words(environment, band);
  if (sonar::differs_with_place(environment)) subtitle << ", bearing " << bearing.value * 180.0 / std::numbers::pi << " degrees";
  std::ostringstream text;
  text << "$curves << EOD\n"
       << curves(field) << "EOD\nset xlabel 'range (km)'\nset xrange [0:" << field.range_m.back() / 1000.0
       << "]\nset tics out nomirror\nset grid lc rgb '#dddddd'\nset lmargin 10\nset key top right\nset multiplot layout 2,1\n"
       << title(environment.name, subtitle.str()) << "set ylabel 'transmission loss (dB re 1 m)'\nset yrange [*:*] reverse\n"
       << curves_of(field, "2") << "\nset title ''\nset ylabel 'SNR (dB)'\nset yrange [*:*] noreverse\n"
       << curves_of(field, "3") << ", " << detection_threshold.value << " with lines lc rgb '#a63603' dt (6,4) title 'detection threshold, "
       << detection_threshold.value << " dB'\nunset multiplot\n";
  draw(path, {.title = "Transmission loss and SNR against range: " + environment.name, .size = "1200,760", .commands = text.str()});
}

void plot_field(const std::filesystem::path& path, const sonar::SonarField& field, const ocean::Environment& environment,
                const ocean::Band& band, Radians bearing, Decibels detection_threshold) {
  if (field.depth_m.size() == 1 || field.range_m.size() == 1)
    return plot_curves(path, field, environment, band, bearing, detection_threshold);
  const float deepest_m = *std::max_element(field.sea_floor_depth_m.begin(), field.sea_floor_depth_m.end());
  const double bottom_m = std::max(1.03 * static_cast<double>(deepest_m), field.depth_m.back());
  std::ostringstream subtitle;
  subtitle << sound_words(environment, band);
  if (sonar::differs_with_place(environment)) subtitle << ", bearing " << bearing.value * 180.0 / std::numbers::pi << " degrees";
  std::ostringstream text;
  text << title(environment.name, subtitle.str()) << "set xlabel 'range (km)'\nset ylabel 'depth (m)'\nset yrange [" << bottom_m
       << ":0]\nset xrange [0:" << field.range_m.back() / 1000.0 << "]\n"
       << snr_scale(detection_threshold)
       << "set tics out nomirror\nset key below reverse Left samplen 2 maxrows 1\nset style fill solid\n$field << EOD\n"
       << surface(field) << "EOD\n$floor << EOD\n"
       << sea_floor(field) << "EOD\n$source << EOD\n0 " << environment.source.depth.value << "\nEOD\n"
       << "plot $field with image notitle, $floor using 1:2:(" << bottom_m << ") with filledcurves fc rgb '#8c7b6b' notitle, "
       << "$floor with lines lc rgb 'black' lw 1.5 title 'sea floor', $source with points pt 7 ps 1.4 lc rgb 'black' title 'source', "
       << "NaN with boxes fc rgb '#d98b45' title 'warm colours: heard, SNR of " << detection_threshold.value << " dB or more'\n";
  draw(path, {.title = "SNR against range and depth: " + environment.name, .size = "1200,640", .commands = text.str()});
}

void plot_map(const std::filesystem::path& path, const sonar::Fan& fan, const ocean::Environment& environment, const ocean::Band& band,
              Meters side, const sonar::Detector& detector) {
  const sonar::HorizontalMap map = sonar::make_map(fan, 0, {.side = side, .intervals = kMaxPoints}, detector);
  std::ostringstream subtitle;
  subtitle << "threshold " << detector.detection_threshold.value << " dB, SNR fluctuates by " << detector.fluctuation.value
           << " dB, hydrophone at " << fan.depth_m.front() << " m";
  std::ostringstream text;
  text << map_data(map, fan, detector)
       << "set xlabel 'east (km)'\nset ylabel 'north (km)' offset 1,0\nset size ratio -1\nset tics out nomirror\nset key below samplen 2\n"
       << "set xrange [" << map.east_m.front() / 1000.0 << ':' << map.east_m.back() / 1000.0 << "]\nset yrange ["
       << map.north_m.front() / 1000.0 << ':' << map.north_m.back() / 1000.0 << "]\nset multiplot layout 1,2\n"
       << title(environment.name, sound_words(environment, band)) << snr_scale(detector.detection_threshold) << map_picture("snr")
       << title("Detection", subtitle.str()) << kProbabilityColours << map_picture("probability") << "unset multiplot\n";
  draw(path, {.title = "SNR and detection around the source: " + environment.name, .size = "1500,760", .commands = text.str()});
}

}  // namespace earshot::plot
