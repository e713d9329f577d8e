#include "firmware/boards/linux/hydrophone/sample_meter.hpp"

#include <gtest/gtest.h>

#include <cstdint>

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
