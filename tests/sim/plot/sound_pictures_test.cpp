#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "sim/plot/operating_curve_plot.hpp"
#include "sim/plot/spectrogram_plot.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::plot {
namespace {

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(SpectrogramPlot, IsDrawnOfSilenceAndOfNothingHeardAsWell) {
  const support::TemporaryFolder folder;
  spectrum::ShortTimeSpectrum windows(Hertz{100}, 2);
  spectrum::Spectrogram spectrogram(1000, windows, Hertz{40});
  windows.take(std::vector<float>(1000, 0.0F), 0,
               [&spectrogram](std::span<const float> psd, std::uint64_t begin) { spectrogram.take(psd, begin); });
  plot_spectrogram(folder / "silent.svg", spectrogram, Decibels{0}, {},
                   {.title = "silence", .subtitle = "it's `nothing`", .level = "dB", .colours_from = Hertz{5}});
  EXPECT_NE(content_of(folder / "silent.svg").find("it's `nothing`"), std::string::npos);
}

TEST(OperatingCurvePlot, IsDrawnWhereNothingWasMissedAndNoAlarmWasFalse) {
  const support::TemporaryFolder folder;
  const annotation::Score perfect{.truths = 3, .detections = 3, .hits = 3, .hours = 0.5};
  plot_operating_curve(folder / "roc.svg", {{5.0, perfect}, {6.0, perfect}}, "song.wav", "fin");
  EXPECT_NE(content_of(folder / "roc.svg").find(">5 dB<"), std::string::npos);
}

}  // namespace
}  // namespace earshot::plot
