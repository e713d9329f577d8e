#include "policy/report/sound/sound_plots.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

HeardSound heard(double snr_db) {
  return {.measurements = {{.time_s = 100.0, .snr_db = snr_db, .too_faint = false, .modelled_snr_db = 5.0, .modelled_too_faint = false}},
          .spectrogram = {.frequency_hz = {5, 6, 7}, .time_s = {1, 200}, .level_db = {80, 81, 82, 80.5, 81.5, 95}}};
}

TEST(SoundPlots, ShowMeasuredAndModelledSnrOverTheSpectrogram) {
  const std::string svg = sound_svg(heard(12.5), Decibels{10.0}, {});
  for (const char* label : {">measured<", ">modelled<", ">frequency (Hz)<", ">SNR (dB)<"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  EXPECT_TRUE(support::has_line(svg, {"SNR", "measured", "spectrogram"}));
}

TEST(SoundPlots, MarkASpectrogramWhereAMeasurementReachesTheThreshold) {
  const auto marks = [](double snr_db) {
    const std::string svg = sound_svg(heard(snr_db), Decibels{10.0}, {});
    std::size_t found = 0;
    for (std::size_t at = svg.find("<use xlink:href='#gpPt4'"); at != std::string::npos; at = svg.find("<use xlink:href='#gpPt4'", at + 1))
      ++found;
    return found;
  };
  EXPECT_EQ(marks(10.0), 1U);
  EXPECT_EQ(marks(9.9), 0U);
}

}  // namespace
}  // namespace earshot::report
