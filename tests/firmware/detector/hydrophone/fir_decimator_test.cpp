#include "firmware/detector/hydrophone/fir_decimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace earshot::detector {
namespace {

/// 1 kHz down to 125 Hz, flat up to 36 Hz.
FirDesign designed() {
  FirDesign design;
  design_fir(Hertz{1000}, 8, Hertz{36}, design);
  return design;
}

// Values: scipy 1.10.1, scipy.signal.firwin(97, 62.5, window=("kaiser", 0.1102 * (80 - 8.7)), fs=1000).
TEST(FirDesign, HasTheTapsThatScipyDesigns) {
  const FirDesign design = designed();
  ASSERT_EQ(design.tap_count, 112U);  // 97, padded to whole vectors at the oldest end
  EXPECT_EQ(design.delay, 48.0);
  const float* const taps = design.taps.data() + 112 - 97;
  EXPECT_EQ(design.taps[14], 0.0F);
  const double tolerance = 1e-8;  // of a float of 0.125, rounded
  EXPECT_NEAR(double{taps[1]}, -1.2087569911650947e-05, tolerance);
  EXPECT_NEAR(double{taps[10]}, 0.0003609581423316433, tolerance);
  EXPECT_NEAR(double{taps[20]}, -0.0028974426898747863, tolerance);
  EXPECT_NEAR(double{taps[48]}, 0.12499770052765427, tolerance);
  EXPECT_EQ(taps[48 - 31], taps[48 + 31]) << "linear phase";
}

TEST(FirDesign, SaysHowManyTapsItLacks) {
  FirDesign design;
  EXPECT_GT(design_fir(Hertz{96'000}, 400, Hertz{12}, design), config::kFirTaps);
}

/// What the decimator makes of `samples` that come in pieces of `piece`.
std::vector<float> decimated(const FirDesign& design, const std::vector<float>& samples, std::size_t piece) {
  FirHistory<config::kFirTaps> history;
  std::vector<float> out;
  std::array<float, config::kSoundChunk> made{};
  for (std::size_t i = 0; i < samples.size();) {
    const std::size_t count = std::min(piece, samples.size() - i);
    std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(i), count, history.room(design));
    const std::size_t n = history.take(design, count, made.data());
    out.insert(out.end(), made.begin(), made.begin() + static_cast<std::ptrdiff_t>(n));
    i += count;
  }
  return out;
}

std::vector<float> tone(double frequency, double rate, std::size_t count) {
  std::vector<float> samples(count);
  for (std::size_t i = 0; i < count; ++i) samples[i] = static_cast<float>(std::sin(2.0 * M_PI * frequency * static_cast<double>(i) / rate));
  return samples;
}

TEST(FirHistory, GivesTheSameBitsHoweverItsSamplesComeInPieces) {
  const FirDesign design = designed();
  const std::vector<float> samples = tone(21.3, 1000, 5003);
  const std::vector<float> whole = decimated(design, samples, config::kSoundChunk);
  EXPECT_EQ(whole.size(), 625U);
  for (const std::size_t piece : {1U, 7U, 8U, 9U, 1000U}) EXPECT_EQ(decimated(design, samples, piece), whole) << piece;
}

/// Greatest absolute value after the beginning.
double amplitude(const std::vector<float>& samples) {
  double most = 0.0;
  for (std::size_t i = samples.size() / 4; i < samples.size(); ++i) most = std::max(most, std::abs(double{samples[i]}));
  return most;
}

TEST(FirHistory, LetsTheBandPassAndHoldsDownWhatWouldFoldOntoIt) {
  const FirDesign design = designed();
  EXPECT_NEAR(amplitude(decimated(design, tone(21.3, 1000, 20'000), 1000)), 1.0, 5e-4);  // ripple 1e-4, and where samples miss the crest
  for (const double image : {125.0 - 30.0, 125.0 + 20.0, 250.0 - 35.9, 500.0 - 20.0})
    EXPECT_LT(amplitude(decimated(design, tone(image, 1000, 20'000), 1000)), 1.1e-4) << image;  // 80 dB is 1e-4
}

TEST(FirHistory, PassesEverythingAsItIsWhereNothingIsToBeLeftOut) {
  FirDesign design;
  design_fir(Hertz{100}, 1, Hertz{36}, design);
  const std::vector<float> samples = tone(21.3, 100, 3000);
  EXPECT_EQ(decimated(design, samples, 100), samples);
}

}  // namespace
}  // namespace earshot::detector
