#include "sim/apps/fly/hearing/hearing_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace earshot::fly {
namespace {

constexpr Decibels kFullScale{180.0};
constexpr Hertz kRate{1000.0};

messages::HydrophoneBlock block_from(std::int64_t first_sample) {
  messages::HydrophoneBlock block;
  block.first_sample = first_sample;
  block.sample_rate = kRate;
  block.samples_per_channel = 1000;
  block.channels = 1;
  return block;
}

/// A tone of 20 Hz, 40 dB under full scale (its root mean square 43 dB), second by second.
void sound_for(int seconds, SpectrogramStrip& strip) {
  std::vector<float> samples(1000);
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = static_cast<float>(0.01 * std::sin(2.0 * std::numbers::pi * 20.0 * static_cast<double>(i) / 1000.0));
  for (int second = 0; second < seconds; ++second) strip.take(block_from(1000 * second), samples);
}

std::vector<std::vector<double>> rows_of(const std::string& table) {
  std::istringstream lines(table);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

TEST(SpectrogramStrip, ShowsATonesLevelAtItsFrequencyAndNothingElsewhere) {
  SpectrogramStrip strip(kRate, kFullScale);
  sound_for(20, strip);
  const auto rows = rows_of(strip.table());
  ASSERT_EQ(rows.size(), 10U);
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 1U + SpectrogramStrip::kHighest_hz - SpectrogramStrip::kLowest_hz + 1U);
    // 180 - 40 - 3.01 dB over the 1.5 Hz of a Hann window's noise width: 1.76 dB less; written to 0.1 dB.
    EXPECT_NEAR(row[1 + 20 - SpectrogramStrip::kLowest_hz], 180.0 - 43.01 - 1.76, 0.06);
    EXPECT_LT(row[1 + 30 - SpectrogramStrip::kLowest_hz], 60.0);
  }
  EXPECT_EQ(rows[0][0], 1.0);  // the middle of two seconds
  EXPECT_EQ(rows[9][0], 19.0);
}

TEST(SpectrogramStrip, HoldsALongSoundInNoMoreThanItsRows) {
  SpectrogramStrip strip(kRate, kFullScale);
  sound_for(10'000, strip);
  const auto rows = rows_of(strip.table());
  // 600 rows of 2 s hold 1200 s; doubled four times they are of 32 s each.
  ASSERT_EQ(rows.size(), 313U);
  EXPECT_EQ(rows[0][0], 16.0);
  EXPECT_EQ(rows[312][0], 312 * 32.0 + 16.0);
  for (const auto& row : rows) EXPECT_NEAR(row[1 + 20 - SpectrogramStrip::kLowest_hz], 180.0 - 43.01 - 1.76, 0.06);
}

TEST(SpectrogramStrip, LeavesTheTimeOutInWhichNoSoundCame) {
  SpectrogramStrip strip(kRate, kFullScale);
  sound_for(4, strip);
  std::vector<float> samples(1000, 0.001F);
  strip.take(block_from(20'000), samples);
  const auto rows = rows_of(strip.table());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2][0], 21.0);
}

}  // namespace
}  // namespace earshot::fly
