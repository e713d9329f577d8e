#include "sim/plot/spectrogram_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "sim/plot/gnuplot.hpp"

namespace earshot::plot {
namespace {

/// Bars nearer than that make a black picture and a slow gnuplot.
constexpr std::size_t kMostMarks = 2000;

struct TimeUnit {
  const char* name;
  double seconds;
};

TimeUnit unit_for(double duration_s) {
  if (duration_s < 600.0) return {"s", 1.0};
  if (duration_s < 3.0 * 3600.0) return {"min", 60.0};
  return {"h", 3600.0};
}

std::string image(const spectrum::Spectrogram& s, Decibels correction, TimeUnit unit) {
  std::ostringstream data;
  for (std::size_t column = 0; column < s.columns(); ++column) {
    const double time = (static_cast<double>(column) + 0.5) * s.seconds_per_column() / unit.seconds;
    for (std::size_t row = 0; row < s.rows(); ++row) {
      const double level = s.level_db(column, row) + correction.value;
      data << time << ' ' << s.frequency_of(row).value << ' ';
      if (std::isfinite(level))
        data << level << '\n';
      else
        data << "NaN\n";
    }
  }
  return data.str();
}

/// Two bars for each mark, above and below it, so that nothing of it is covered; wide enough to be seen.
std::string bars(const std::vector<Mark>& marks, TimeUnit unit, double duration_s, double highest_hz) {
  const double gap_hz = 0.01 * highest_hz;
  const double height_hz = 0.014 * highest_hz;
  const double least_s = duration_s / 400.0;
  std::ostringstream data;
  for (std::size_t i = 0; i < std::min(marks.size(), kMostMarks); ++i) {
    const Mark& mark = marks[i];
    const double middle_s = 0.5 * (mark.begin_s + mark.end_s);
    const double half_s = 0.5 * std::max(mark.end_s - mark.begin_s, least_s);
    for (const double middle_hz : {mark.high.value + gap_hz + 0.5 * height_hz, mark.low.value - gap_hz - 0.5 * height_hz})
      data << middle_s / unit.seconds << ' ' << middle_hz << ' ' << (middle_s - half_s) / unit.seconds << ' '
           << (middle_s + half_s) / unit.seconds << ' ' << middle_hz - 0.5 * height_hz << ' ' << middle_hz + 0.5 * height_hz << '\n';
  }
  return data.str();
}

}  // namespace

void plot_spectrogram(const std::filesystem::path& path, const spectrum::Spectrogram& spectrogram, Decibels correction,
                      const std::vector<Mark>& marks, const SpectrogramCaption& caption) {
  const double duration_s = static_cast<double>(spectrogram.columns()) * spectrogram.seconds_per_column();
  const TimeUnit unit = unit_for(duration_s);
  const double highest_hz = static_cast<double>(std::max<std::size_t>(spectrogram.rows() - 1, 1)) * spectrogram.hertz_per_row().value;
  std::ostringstream text;
  text.precision(9);
  text << "set title " << quoted(caption.title) << ".\"\\n\"." << quoted(caption.subtitle) << " noenhanced\nset xlabel 'time (" << unit.name
       << ")'\nset ylabel 'frequency (Hz)'\nset cblabel " << quoted(caption.level) << " noenhanced offset 1,0\n"
       << "set tics out nomirror\nset key off\nset xrange [0:" << duration_s / unit.seconds << "]\nset yrange [0:" << highest_hz << "]\n"
       << "set palette defined (0 '#0b0924', 1 '#4a1c6b', 2 '#a02c60', 3 '#e35933', 4 '#f9a31a', 5 '#fcffa4')\n";
  const double low_db = spectrogram.percentile_db(10.0, caption.colours_from) + correction.value;
  const double high_db = spectrogram.percentile_db(99.9, caption.colours_from) + correction.value;
  if (high_db > low_db) text << "set cbrange [" << low_db << ':' << high_db << "]\n";
  text << "$levels << EOD\n" << image(spectrogram, correction, unit) << "EOD\n";
  if (!marks.empty()) text << "$marks << EOD\n" << bars(marks, unit, duration_s, highest_hz) << "EOD\n";
  text << "plot $levels with image";
  if (!marks.empty()) text << ", $marks with boxxyerror lc rgb '#5fd7ff' fs solid noborder";
  text << '\n';
  draw(path, {.title = caption.title, .size = "1500,520", .commands = text.str()});
}

}  // namespace earshot::plot
