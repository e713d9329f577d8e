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
  for (const char* part : {">5 to 6 dB<", "labels: thresholds in dB", "0 is drawn as 0.5 of a false alarm or call"})
    EXPECT_NE(content_of(folder / "roc.svg").find(part), std::string::npos) << part;
}

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(OperatingCurvePlot, LaysNoLabelOnAnother) {
  const support::TemporaryFolder folder;
  // 20 truths; thresholds of 1 to 6 dB find all of them, those of 7 and 8 nearly lie on one another, that of 20 lies apart.
  const annotation::Score all{.truths = 2000, .detections = 2000, .hits = 2000, .hours = 1.0};
  std::vector<annotation::OperatingPoint> points;
  for (int threshold_db = 1; threshold_db <= 6; ++threshold_db) points.push_back({static_cast<double>(threshold_db), all});
  points.push_back({7.0, {.truths = 2000, .detections = 1001, .hits = 1000, .hours = 1.0}});
  points.push_back({8.0, {.truths = 2000, .detections = 1000, .hits = 999, .hours = 1.0}});
  points.push_back({20.0, {.truths = 2000, .detections = 100, .hits = 100, .hours = 1.0}});
  plot_operating_curve(folder / "roc.svg", points, "song.wav", "fin");
  const std::string svg = content_of(folder / "roc.svg");
  EXPECT_EQ(occurrences(svg, ">1 to 6 dB<"), 2U) << "one in each picture";
  EXPECT_EQ(occurrences(svg, ">3 dB<"), 0U);
  EXPECT_EQ(occurrences(svg, ">7 dB<"), 2U);
  EXPECT_EQ(occurrences(svg, ">8 dB<"), 0U);
}

TEST(OperatingCurvePlot, PutsLabelsOfItsRightEndToTheLeftOfTheirPointsWithinTheFrame) {
  const support::TemporaryFolder folder;
  const std::vector<annotation::OperatingPoint> points{{0.0, {.truths = 20, .detections = 120, .hits = 20, .hours = 1.0}},
                                                       {10.0, {.truths = 20, .detections = 15, .hits = 14, .hours = 1.0}}};
  plot_operating_curve(folder / "roc.svg", points, "song.wav", "fin");
  const std::string svg = content_of(folder / "roc.svg");
  const auto side_of = [&svg](const std::string& label) {
    const std::size_t anchor = svg.rfind("text-anchor=\"", svg.find(">" + label + "<"));
    return svg.substr(anchor + 13, svg.find('"', anchor + 13) - anchor - 13);
  };
  EXPECT_EQ(side_of("0 dB"), "end");
  EXPECT_EQ(side_of("10 dB"), "start");
}

TEST(SpectrogramPlot, CoversNothingOfWhatItMarks) {
  const support::TemporaryFolder folder;
  spectrum::ShortTimeSpectrum windows(Hertz{100}, 2);
  spectrum::Spectrogram spectrogram(100'000, windows, Hertz{40});
  // A call of a second in 1000 s is narrower than a frame's two lines.
  plot_spectrogram(folder / "a.svg", spectrogram, Decibels{0}, {{500.0, 501.0, Hertz{15}, Hertz{30}}},
                   {.title = "a", .subtitle = "b", .level = "dB", .colours_from = Hertz{5}});
  const std::string svg = content_of(folder / "a.svg");
  EXPECT_EQ(occurrences(svg, "<polygon fill = 'rgb( 95, 215, 255)'"), 2U) << "a bar above and one below";
}

}  // namespace
}  // namespace earshot::plot
