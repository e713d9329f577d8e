#include "sim/sonar/field_plot.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace earshot::sonar {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

/// At most this many points along either axis: more than a picture shows only makes it slow.
constexpr std::size_t kMaxPoints = 500;

std::string surface(const SonarField& field) {
  const std::size_t range_stride = std::max<std::size_t>(1, field.range_m.size() / kMaxPoints);
  const std::size_t depth_stride = std::max<std::size_t>(1, field.depth_m.size() / kMaxPoints);
  std::ostringstream data;
  for (std::size_t i = 0; i < field.range_m.size(); i += range_stride) {
    for (std::size_t j = 0; j < field.depth_m.size(); j += depth_stride) {
      data << field.range_m[i] / 1000.0 << ' ' << field.depth_m[j] << ' '
           << field.snr_db(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) << '\n';
    }
  }
  return data.str();
}

std::string script(const std::filesystem::path& temporary, const std::string& terminal, const SonarField& field, const std::string& title,
                   Decibels detection_threshold) {
  std::ostringstream text;
  text << "set terminal " << terminal << " size 1100,500\n"
       << "set output " << quoted(temporary.string()) << "\nset title " << quoted(title) << " noenhanced\n"
       << "set xlabel 'range (km)'\nset ylabel 'depth (m)'\nset cblabel 'SNR (dB)'\n"
       << "set yrange [*:*] reverse\nset cbrange [" << detection_threshold.value - 20.0 << ':' << detection_threshold.value + 20.0
       << "]\n"
       // Cold below the threshold and warm above it, so that the colour change is the edge of detection.
       << "set palette defined (0 '#081d58', 20 '#a6cee3', 20 '#fee391', 40 '#cc4c02')\n"
       << "set autoscale fix\nset tics out\nunset key\n$field << EOD\n"
       << surface(field) << "EOD\nplot $field with image\n";
  return text.str();
}

void run_gnuplot(const std::string& commands) {
  std::FILE* pipe = popen("gnuplot 2>&1 >/dev/null", "w");
  if (pipe == nullptr) throw std::runtime_error("gnuplot cannot be started");
  const bool written = std::fwrite(commands.data(), 1, commands.size(), pipe) == commands.size();
  if (pclose(pipe) != 0 || !written) throw std::runtime_error("gnuplot failed; is the Debian package gnuplot-nox installed?");
}

}  // namespace

void plot_field(const std::filesystem::path& path, const SonarField& field, const std::string& title, Decibels detection_threshold) {
  const std::string extension = path.extension().string();
  if (extension != ".png" && extension != ".svg") throw std::invalid_argument(path.string() + ": a plot's name must end in .png or .svg");
  std::filesystem::path temporary = path;
  temporary += ".part";
  try {
    run_gnuplot(script(temporary, extension == ".png" ? "pngcairo" : "svg", field, title, detection_threshold));
    std::filesystem::rename(temporary, path);
  } catch (const std::exception& e) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(path.string() + ": cannot be drawn: " + e.what());
  }
}

}  // namespace earshot::sonar
