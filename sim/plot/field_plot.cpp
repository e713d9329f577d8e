#include "sim/plot/field_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "sim/plot/depth_rows.hpp"
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

/// Rows of a picture: as many as its axis has pixels, so that each depth of the field begins where it should.
constexpr std::size_t kRows = 500;

std::string surface(const sonar::SonarField& field) {
  const std::size_t stride = stride_of(field.range_m.size());
  const DepthRows rows = depth_rows(field.depth_m, kRows);
  std::ostringstream data;
  for (std::size_t i = 0; i < field.range_m.size(); i += stride) {
    for (std::size_t row = 0; row < rows.depth_m.size(); ++row)
      data << field.range_m[i] / 1000.0 << ' ' << rows.depth_m[row] << ' '
           << value(static_cast<double>(snr_to_draw(field, i, rows.of_field[row]))) << '\n';
  }
  return data.str();
}

/// So many curves can be told apart; of more depths a picture shows rows.
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

/// A closed line around the source.
struct Ring {
  std::string data;
  bool is_seen = false;  ///< some of it lies in the picture
};

/// One range of detection per bearing; between bearings the range is linear, so that a circle looks like one. Where the computation ends
/// before the sound does there is no line: it may be heard further.
Ring ring(const sonar::Fan& fan, const sonar::HorizontalMap& map, double sonar::DetectionRange::*which,
          const std::vector<sonar::DetectionRange>& ranges) {
  constexpr std::size_t kParts = 16;
  const auto at = [&](std::size_t j) {
    const sonar::DetectionRange& range = ranges[j % fan.bearings];
    return sonar::is_heard_to_the_end(fan, range.*which) ? std::numeric_limits<double>::quiet_NaN() : range.*which;
  };
  std::ostringstream data;
  bool is_seen = false;
  for (std::size_t part = 0; part <= fan.bearings * kParts; ++part) {
    const std::size_t j = part / kParts;
    const double fraction = static_cast<double>(part % kParts) / kParts;
    const double angle = sonar::bearing_of(part, fan.bearings * kParts).value;
    const double range_m = sonar::between(at(j), at(j + 1), fraction);
    const double east_m = fan.centre.east.value + range_m * std::sin(angle);
    const double north_m = fan.centre.north.value + range_m * std::cos(angle);
    is_seen = is_seen || (range_m > 0.0 && east_m >= map.east_m.front() && east_m <= map.east_m.back() && north_m >= map.north_m.front() &&
                          north_m <= map.north_m.back());
    data << value(east_m / 1000.0) << ' ' << value(north_m / 1000.0) << '\n';
  }
  return {.data = data.str(), .is_seen = is_seen};
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

/// What a picture of a fan shows, as gnuplot's data blocks, and what is plotted of it over $snr or $probability.
struct MapLayers {
  std::string data;
  std::string over;
};

/// A key to what no line says: that it is heard on every bearing as far as was computed, or on none.
std::string key_without_line(const sonar::Fan& fan, const std::vector<sonar::DetectionRange>& ranges) {
  std::ostringstream text;
  if (std::ranges::all_of(ranges, [&](const sonar::DetectionRange& r) { return sonar::is_heard_to_the_end(fan, r.furthest_m); }))
    text << ", NaN with points ps 0 title 'heard as far as computed, " << fan.max_range().value / 1000.0 << " km'";
  else if (std::ranges::none_of(ranges, [](const sonar::DetectionRange& r) { return r.furthest_m > 0.0; }))
    text << ", NaN with points ps 0 title 'heard nowhere'";
  return text.str();
}

MapLayers map_layers(const sonar::HorizontalMap& map, const sonar::Fan& fan, const sonar::Detector& detector) {
  const std::vector<sonar::DetectionRange> ranges = sonar::detection_ranges(fan, 0, detector);
  const Ring assured = ring(fan, map, &sonar::DetectionRange::assured_m, ranges);
  const Ring furthest = ring(fan, map, &sonar::DetectionRange::furthest_m, ranges);
  std::ostringstream text;
  text << "$snr << EOD\n"
       << plane(map, map.snr_db) << "EOD\n$probability << EOD\n"
       << plane(map, map.detection_probability) << "EOD\n$assured << EOD\n"
       << assured.data << "EOD\n$furthest << EOD\n"
       << furthest.data << "EOD\n$source << EOD\n"
       << fan.centre.east.value / 1000.0 << ' ' << fan.centre.north.value / 1000.0 << "\nEOD\n";
  std::string over;
  if (assured.is_seen) over += ", $assured with lines lc rgb 'black' lw 2 title 'heard at every range within'";
  if (furthest.is_seen) over += ", $furthest with lines lc rgb 'black' lw 2 dt (6,4) title 'heard nowhere beyond'";
  over += ", $source with points pt 3 ps 1.6 lw 2 lc rgb 'black' title 'source'" + key_without_line(fan, ranges);
  return {.data = text.str(), .over = over};
}

std::string map_picture(const std::string& values, const MapLayers& layers) {
  return "plot $" + values + " with image notitle" + layers.over + "\n";
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
       << "]\nset tics out nomirror\nset grid lc rgb '#dddddd'\nset lmargin 10\nset rmargin 34\nset key outside right top Left reverse\n"
       << "set offsets 0, 0, graph 0.05, graph 0.05\nset multiplot layout 2,1\n"
       << title(environment.name, subtitle.str()) << "set ylabel 'transmission loss (dB re 1 m)'\nset yrange [*:*] reverse\n"
       << curves_of(field, "2") << "\nset title ''\nset ylabel 'SNR (dB)'\nset yrange [*:*] noreverse\n"
       << curves_of(field, "3") << ", " << detection_threshold.value << " with lines lc rgb '#a63603' dt (6,4) title 'detection threshold, "
       << detection_threshold.value << " dB'\nunset multiplot\n";
  draw(path, {.title = "Transmission loss and SNR against range: " + environment.name, .size = "1200,760", .commands = text.str()});
}

void plot_field(const std::filesystem::path& path, const sonar::SonarField& field, const ocean::Environment& environment,
                const ocean::Band& band, Radians bearing, Decibels detection_threshold) {
  if (field.depth_m.size() <= kMostCurves || field.range_m.size() == 1)
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
  subtitle << "threshold " << detector.detection_threshold.value << " dB, SNR ";
  if (detector.fluctuation.value > 0.0)
    subtitle << "fluctuates by " << detector.fluctuation.value << " dB";
  else
    subtitle << "does not fluctuate";
  subtitle << ", hydrophone at " << fan.depth_m.front() << " m";
  const MapLayers layers = map_layers(map, fan, detector);
  std::ostringstream text;
  text << layers.data
       << "set xlabel 'east (km)'\nset ylabel 'north (km)' offset 1,0\nset size ratio -1\nset tics out nomirror\nset key below samplen 2\n"
       << "set xrange [" << map.east_m.front() / 1000.0 << ':' << map.east_m.back() / 1000.0 << "]\nset yrange ["
       << map.north_m.front() / 1000.0 << ':' << map.north_m.back() / 1000.0 << "]\nset multiplot layout 1,2\n"
       << title(environment.name, sound_words(environment, band)) << snr_scale(detector.detection_threshold) << map_picture("snr", layers)
       << title("Detection", subtitle.str()) << kProbabilityColours << map_picture("probability", layers) << "unset multiplot\n";
  draw(path, {.title = "SNR and detection around the source: " + environment.name, .size = "1500,760", .commands = text.str()});
}

}  // namespace earshot::plot
