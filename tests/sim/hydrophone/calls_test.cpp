#include "sim/hydrophone/calls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace earshot::hydrophone {
namespace {

double mean_square(const auto& calls, double from_s, double to_s) {
  const int count = 20'000;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double value = calls.at(from_s + (i + 0.5) * (to_s - from_s) / count);
    sum += value * value / count;
  }
  return sum;
}

const Song kSong{.pattern = {.interval_s = 15.0, .song_s = 100.0, .pause_s = 50.0, .listening_s = 1.0}, .frequency = Hertz{20.0}};

TEST(Tone, HasAMeanSquareOfOne) {
  EXPECT_NEAR(mean_square(Tone{}, 0.0, 10.0), 1.0, 1e-9);
}

TEST(Tone, EndsATurnAfterAPeriod) {
  EXPECT_NEAR(Tone{.frequency = Hertz{20.0}}.at(1234.05), std::numbers::sqrt2, 1e-9);  // 24 681 turns
  EXPECT_NEAR(Tone{.frequency = Hertz{20.0}}.at(1234.025), -std::numbers::sqrt2, 1e-9);
}

TEST(Song, HasAMeanSquareOfOneOverThePulsesSecond) {
  EXPECT_NEAR(mean_square(kSong, 15.0, 16.0), 1.0, 1e-3);  // but for the cross term with twice the frequency, whose mean is not quite zero
}

TEST(Song, SweepsFromTwentyThreeToEighteenHertz) {
  // Zeros of cos(2 pi (23 t - 2.5 t^2)), solved by hand: 23 t - 2.5 t^2 = 0.25 and 20.25.
  EXPECT_NEAR(kSong.at(0.010882), 0.0, 1e-4);
  EXPECT_NEAR(kSong.at((23.0 - std::sqrt(23.0 * 23.0 - 4.0 * 2.5 * 20.25)) / 5.0 + 30.0), 0.0, 1e-9);
}

TEST(Song, SwellsAndDiesAwayWithoutAStep) {
  EXPECT_NEAR(kSong.at(15.0 + 1e-4), 0.0, 1e-6);
  EXPECT_NEAR(kSong.at(16.0 - 1e-4), 0.0, 1e-6);
}

TEST(Song, IsSilentBetweenPulsesAndInThePause) {
  EXPECT_EQ(mean_square(kSong, 1.0, 15.0), 0.0);
  EXPECT_GT(mean_square(kSong, 90.0, 91.0), 0.9) << "the seventh and last pulse of 100 s";
  EXPECT_EQ(mean_square(kSong, 91.0, 150.0), 0.0);
  EXPECT_GT(mean_square(kSong, 150.0, 151.0), 0.9) << "the next song";
}

TEST(Song, HasBeenSungBeforeTheClockBegan) {
  EXPECT_GT(mean_square(kSong, -150.0, -149.0), 0.9);
  EXPECT_EQ(mean_square(kSong, -40.0, -1.0), 0.0);
}

TEST(Recording, PassesThroughItsSamplesAndBeginsAgain) {
  const Recording recording{.samples = {0.0F, 1.0F, -2.0F, 0.5F}, .sample_rate = Hertz{2.0}};
  EXPECT_DOUBLE_EQ(recording.at(0.5), 1.0);
  EXPECT_DOUBLE_EQ(recording.at(1.0), -2.0);
  EXPECT_DOUBLE_EQ(recording.at(2.5), 1.0);
  EXPECT_DOUBLE_EQ(recording.at(-0.5), 0.5);
}

TEST(Recording, IsACubicBetweenItsSamples) {
  // Catmull and Rom by hand, half way between 1 and -2 with neighbours 0 and 0.5: (-0 + 9 - 18 - 0.5) / 16.
  const Recording recording{.samples = {0.0F, 1.0F, -2.0F, 0.5F}, .sample_rate = Hertz{2.0}};
  EXPECT_NEAR(recording.at(0.75), -9.5 / 16.0, 1e-12);
}

TEST(Recording, KeepsALowToneBetweenItsSamples) {
  Recording recording{.samples = {}, .sample_rate = Hertz{1000.0}};
  for (int i = 0; i < 1000; ++i)
    recording.samples.push_back(static_cast<float>(std::sin(2.0 * std::numbers::pi * 20.0 * static_cast<double>(i) / 1000.0)));
  double worst = 0.0;
  for (double t = 0.0; t < 1.0; t += 1.7e-4)
    worst = std::max(worst, std::abs(recording.at(t) - std::sin(2.0 * std::numbers::pi * 20.0 * t)));
  EXPECT_LT(worst, 3e-4);  // a cubic's error is about (w h)^3 / 24 sqrt(3) times a few: 5e-5 at 20 Hz of 1 kHz
}

}  // namespace
}  // namespace earshot::hydrophone
