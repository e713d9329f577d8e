#include "firmware/boards/linux/hydrophone/sample_meter.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace earshot::board {
namespace {

messages::HydrophoneBlock block_at(std::int64_t sequence, std::int64_t first_sample) {
  return {.time = {},
          .sequence = sequence,
          .first_sample = first_sample,
          .sample_rate = Hertz{48'000},
          .gain = Decibels{20},
          .samples_per_channel = 100,
          .channels = 2};
}

TEST(SampleMeter, MissesNothingWhereOneBlockFollowsTheOtherWhereverTheCounterBegan) {
  SampleMeter meter;
  for (std::int64_t i = 0; i < 10; ++i) meter.hear(block_at(5 + i, 7'000 + 100 * i), {});
  EXPECT_EQ(meter.read().samples_heard, 1000U);
  EXPECT_EQ(meter.read().samples_missing, 0U);
  EXPECT_EQ(meter.read().beginnings, 1U);
}

TEST(SampleMeter, TellsSamplesLostOnTheirWayFromThoseThatTheSenderNeverSent) {
  SampleMeter meter;
  meter.hear(block_at(0, 0), {});
  meter.hear(block_at(3, 300), {});  // blocks 1 and 2 are lost
  meter.hear(block_at(4, 437), {});  // 37 samples that no block held
  EXPECT_EQ(meter.read().samples_heard, 300U);
  EXPECT_EQ(meter.read().samples_missing, 237U);
  EXPECT_EQ(meter.read().missing_at_sender, 37U);
}

TEST(SampleMeter, TakesASenderThatStartsAgainForANewBeginningAndNotForAGap) {
  SampleMeter meter;
  meter.hear(block_at(1000, 100'000), {});
  meter.hear(block_at(0, 0), {});
  meter.hear(block_at(1, 100), {});
  messages::HydrophoneBlock faster = block_at(2, 999'999);
  faster.sample_rate = Hertz{96'000};
  meter.hear(faster, {});
  messages::HydrophoneBlock wider = faster;
  wider.first_sample += 5000;
  wider.channels = 3;
  meter.hear(wider, {});
  EXPECT_EQ(meter.read().samples_missing, 0U);
  EXPECT_EQ(meter.read().beginnings, 4U);
}

/// 48 000 samples of each channel are a second; the counter after `samples` of them, at the date that the sender's clock then shows.
messages::HydrophoneBlock block_after(std::int64_t sequence, std::int64_t samples, double date_s) {
  messages::HydrophoneBlock block = block_at(sequence, samples);
  block.time = Time{1'795'000'000'000'000 + static_cast<std::int64_t>(date_s * 1e6)};
  return block;
}

TEST(SampleMeter, CountsAJumpThatNoAdcMakesApartAndNotAsLost) {
  SampleMeter meter;
  meter.hear(block_after(0, 0, 0.0), {});
  meter.hear(block_after(1, std::int64_t{1} << 53, 0.01), {});  // as far as a block may count
  meter.hear(block_after(2, 200, 0.02), {});
  meter.hear(block_after(3, 350, 0.03), {});  // 50 are missing
  EXPECT_EQ(meter.read().samples_missing, 50U);
  EXPECT_EQ(meter.read().jumps, 1U);
  EXPECT_EQ(meter.read().beginnings, 2U) << "the first, and where the counter comes back";
  EXPECT_EQ(meter.read().samples_heard, 400U);
}

TEST(SampleMeter, TakesASilenceOfTwoHoursForALossWhenTheSendersClockWentOnForTwoHours) {
  SampleMeter meter;
  meter.hear(block_after(0, 0, 0.0), {});
  meter.hear(block_after(1, 100 + 7200 * 48'000, 7200.0), {});
  EXPECT_EQ(meter.read().samples_missing, 345'600'000U);
  EXPECT_EQ(meter.read().jumps, 0U);
}

TEST(SampleMeter, AllowsASendersClockAMinuteByWhichItWasSetBack) {
  SampleMeter meter;
  meter.hear(block_after(0, 0, 0.0), {});
  meter.hear(block_after(1, 100 + 60 * 48'000, 0.0), {});
  EXPECT_EQ(meter.read().samples_missing, 2'880'000U);
  EXPECT_EQ(meter.read().jumps, 0U);
  meter.hear(block_after(2, 200 + 60 * 48'000 + 60 * 48'000 + 1, 0.0), {});
  EXPECT_EQ(meter.read().samples_missing, 2'880'000U);
  EXPECT_EQ(meter.read().jumps, 1U);
}

TEST(SampleMeter, TakesNoMoreThanADayForALossWhateverTheDatesSay) {
  SampleMeter meter;
  constexpr std::int64_t kDay = 86'400LL * 48'000;
  meter.hear(block_after(0, 0, 0.0), {});
  meter.hear(block_after(1, 100 + kDay, 86'400.0), {});
  EXPECT_EQ(meter.read().samples_missing, 4'147'200'000U);
  meter.hear(block_after(2, 200 + kDay + kDay + 1, 1e9), {});
  EXPECT_EQ(meter.read().samples_missing, 4'147'200'000U);
  EXPECT_EQ(meter.read().jumps, 1U);
}

TEST(SampleMeter, GoesOnFromTheLastSequenceNumberThatThereIs) {
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  SampleMeter meter;
  meter.hear(block_at(kLast - 1, 0), {});
  meter.hear(block_at(kLast, 137), {});  // 37 that no block held
  meter.hear(block_at(0, 300), {});      // 63 more; what the sender counts after the last is not the next
  EXPECT_EQ(meter.read().samples_missing, 100U);
  EXPECT_EQ(meter.read().missing_at_sender, 37U);
}

TEST(SampleMeter, CountsClippedSamplesAndChangesOfGain) {
  SampleMeter meter;
  messages::HydrophoneBlock block = block_at(0, 0);
  for (const double gain_db : {20.0, 20.0, 26.0, 20.0}) {
    block.gain = Decibels{gain_db};
    block.overflow_count = 3;
    meter.hear(block, {});
    ++block.sequence;
    block.first_sample += 100;
  }
  EXPECT_EQ(meter.read().gain_changes, 2U);
  EXPECT_EQ(meter.read().overflows, 12U);
}

}  // namespace
}  // namespace earshot::board
