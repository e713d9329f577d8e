#include "policy/report/sound/sound_plots.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "policy/report/gnuplot/gnuplot_svg.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPoints = 3000;  ///< a picture has no more across
constexpr double kHour_s = 3600.0;

/// Of each group the loudest when there are more than the picture has points across: a call between two of them is not left out.
void write_measurements_file(const fs::path& path, const HeardSound& sound, Decibels threshold) {
  std::ofstream out(path);
  const std::size_t group = sound.measurements.size() / kMostPoints + 1;
  const auto is_fainter = [](const HeardRow& a, const HeardRow& b) { return a.snr_db < b.snr_db; };
  for (std::size_t i = 0; i < sound.measurements.size(); i += group) {
    const auto begin = sound.measurements.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = sound.measurements.begin() + static_cast<std::ptrdiff_t>(std::min(i + group, sound.measurements.size()));
    const HeardRow& measurement = *std::max_element(begin, end, is_fainter);
    const bool reaches = !measurement.too_faint && measurement.snr_db >= threshold.value;
    out << measurement.time_s / kHour_s << ' ' << measurement.snr_db << ' ' << (measurement.too_faint ? 1 : 0) << ' '
        << measurement.modelled_snr_db << ' ' << (measurement.modelled_too_faint ? 1 : 0) << ' ' << (reaches ? 1 : 0) << '\n';
  }
}

void write_decisions(const fs::path& path, const std::vector<explain::RecordedDecision>& decisions) {
  std::ofstream out(path);
  for (const explain::RecordedDecision& d : decisions)
    out << d.time_s() / kHour_s << ' ' << d.snr.value << ' ' << (d.detected ? 1 : 0) << '\n';
}

void write_spectrogram(const fs::path& path, const SpectrogramTable& table) {
  std::ofstream out(path);
  for (std::size_t i = 0; i < table.time_s.size(); ++i) {
    for (std::size_t k = 0; k < table.frequency_hz.size(); ++k)
      out << table.time_s[i] / kHour_s << ' ' << table.frequency_hz[k] << ' ' << table.level_db[i * table.frequency_hz.size() + k] << '\n';
    out << '\n';
  }
}

/// gnuplot's range of colours: from the noise's own level to the loudest, whatever either is.
std::string colours_of(const SpectrogramTable& table) {
  std::vector<double> levels = table.level_db;
  const auto at = [&levels](double share) {
    const auto place = levels.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(levels.size() - 1));
    std::ranges::nth_element(levels, place);
    return *place;
  };
  const double low = at(0.02);
  const double high = std::max(at(0.999), low + 1.0);
  std::ostringstream text;
  text << "set cbrange [" << low << ":" << high << "]\nset palette defined (0 '#10204a', 0.45 '#3f8fc5', 0.75 '#f2e9b5', 1 '#c77d2b')\n";
  return text.str();
}

std::string measured_plot(Decibels threshold) {
  // The line first, so that the dots lie on it; the legend's marks are larger than those of the picture.
  return "plot 'measured.dat' using 1:($5==0?$4:1/0) with lines lw 1.2 lc rgb '#c77d2b' title 'modelled', \\\n"
         " 'measured.dat' using 1:($3==0?$2:1/0) with points pt 7 ps 0.3 lc rgb '#2f6fa5' notitle, \\\n"
         " 'measured.dat' using 1:($3==1?$2:1/0) with points pt 10 ps 0.35 lc rgb '#7f98a9' notitle, \\\n"
         " keyentry with points pt 7 ps 0.7 lc rgb '#2f6fa5' title 'measured', \\\n"
         " keyentry with points pt 10 ps 0.8 lc rgb '#7f98a9' title 'too faint: below this', \\\n " +
         std::to_string(threshold.value) + " with lines lw 1.6 dt (6,4) lc " + kInk +
         " title 'detection threshold', \\\n"
         " 'decisions.dat' using 1:($3==0?$2:1/0) with points pt 6 ps 0.65 lw 2 lc rgb '#c2127a' title 'decision, no detection', \\\n"
         " 'decisions.dat' using 1:($3==1?$2:1/0) with points pt 7 ps 0.65 lc rgb '#c2127a' title 'decision, detection'\n";
}

std::string strip_plot(const SpectrogramTable& table) {
  std::ostringstream text;
  const double top = table.frequency_hz.back() + 3.0;
  text << "set yrange [" << table.frequency_hz.front() << ":" << table.frequency_hz.back() + 5.0
       << "]\nplot 'spectrogram.dat' using 1:2:3 with image notitle, \\\n"
       << " 'measured.dat' using 1:($6==1?" << top << ":1/0) with points pt 5 ps 0.25 lc rgb '#c2127a' notitle\nunset multiplot\n";
  return text.str();
}

}  // namespace

std::string sound_svg(const HeardSound& sound, Decibels threshold, const std::vector<explain::RecordedDecision>& decisions) {
  const PlotFolder scratch;
  write_measurements_file(scratch / "measured.dat", sound, threshold);
  write_decisions(scratch / "decisions.dat", decisions);
  write_spectrogram(scratch / "spectrogram.dat", sound.spectrogram);
  std::ostringstream range;
  range << "set xrange [0:" << std::max(sound.spectrogram.time_s.back(), sound.measurements.back().time_s) / kHour_s << "]\n";
  return svgs_from(scratch,
                   page_style("600,620") + range.str() + R"(
set output 'plot.svg'
set multiplot
set lmargin at screen 0.11
set rmargin at screen 0.84
set bmargin at screen 0.46
set tmargin at screen 0.84
set ylabel 'SNR (dB)' offset 1,0
set format x ''
set key at screen 0.53,0.99 center top vertical maxrows 3
)" + measured_plot(threshold) +
                       R"(
set bmargin at screen 0.12
set tmargin at screen 0.42
set ylabel 'frequency (Hz)'
set xlabel 'time (h)'
set format x '%g'
set ytics 10
set colorbox user origin 0.855,0.12 size 0.018,0.30
set cbtics 20
set cblabel 'dB re 1 µPa²/Hz' noenhanced offset -0.5,0
unset key
)" + colours_of(sound.spectrogram) +
                       strip_plot(sound.spectrogram),
                   {{.file = "plot.svg", .title = "SNR measured and modelled, and the spectrogram of the sound, against time"}})
      .front();
}

}  // namespace earshot::report
