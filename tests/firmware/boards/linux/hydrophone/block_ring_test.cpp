#include "firmware/boards/linux/hydrophone/block_ring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <thread>

namespace earshot::board {
namespace {

/// A block whose samples all say its number. @return false when there was no room
bool put(BlockRing& ring, std::int64_t number, std::size_t samples) {
  const std::span<float> room = ring.room_for(samples);
  if (room.empty()) return false;
  EXPECT_EQ(room.size(), samples);
  std::ranges::fill(room, static_cast<float>(number));
  messages::HydrophoneBlock block;
  block.sequence = number;
  ring.put(block);
  return true;
}

/// Takes the next block, which must be this one, whole.
void expect_next(BlockRing& ring, std::int64_t number, std::size_t samples) {
  BlockRing::SampledBlock oldest;
  ASSERT_TRUE(ring.take(oldest));
  ASSERT_EQ(oldest.block.sequence, number);
  ASSERT_EQ(oldest.samples.size(), samples);
  ASSERT_TRUE(std::ranges::all_of(oldest.samples, [number](float sample) { return sample == static_cast<float>(number); }));
  ring.release();
}

TEST(BlockRing, GivesBlocksInTheirOrderEachInOnePieceRoundItsEnd) {
  BlockRing ring;
  constexpr std::size_t kSamples = 32'749;  // a prime, so that no block ends where the ring does
  std::int64_t last = -1;
  for (std::int64_t number = 0; number < 300; ++number) {
    ASSERT_TRUE(put(ring, number, kSamples));
    if (number % 3 == 2) {
      for (int i = 0; i < 3; ++i) expect_next(ring, ++last, kSamples);
    }
  }
  BlockRing::SampledBlock oldest;
  EXPECT_FALSE(ring.take(oldest));
}

TEST(BlockRing, HoldsTwoSecondsOfEightChannelsAtNinetySixKilohertzAndRefusesTheNewestBeyond) {
  BlockRing ring;
  constexpr std::size_t kSamples = std::size_t{8} * 1024;
  std::int64_t held = 0;
  while (put(ring, held, kSamples)) ++held;
  EXPECT_EQ(held, 256);  // 2^21 / 2^13
  EXPECT_GE(static_cast<double>(held) * 1024 / 96'000, 2.0);
  expect_next(ring, 0, kSamples);
  EXPECT_TRUE(put(ring, 256, kSamples));
  EXPECT_FALSE(put(ring, 257, kSamples));
  for (std::int64_t number = 1; number <= 256; ++number) expect_next(ring, number, kSamples);
}

TEST(BlockRing, RefusesMoreBlocksThanItHasEntriesHoweverSmall) {
  BlockRing ring;
  std::int64_t held = 0;
  while (put(ring, held, 1)) ++held;
  EXPECT_EQ(held, static_cast<std::int64_t>(config::kHydrophoneRingBlocks));
  expect_next(ring, 0, 1);
  EXPECT_TRUE(put(ring, held, 1));
}

TEST(BlockRing, GivesEveryBlockThatItTookWholeAndInOrderBetweenTwoThreads) {
  BlockRing ring;
  constexpr std::int64_t kBlocks = 50'000;
  const auto size_of = [](std::int64_t number) { return static_cast<std::size_t>(1 + number * 7919 % 2000); };
  std::thread putter([&] {
    for (std::int64_t number = 0; number < kBlocks;) {
      if (put(ring, number, size_of(number))) {
        ++number;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::int64_t wrong = 0;
  for (std::int64_t number = 0; number < kBlocks;) {
    BlockRing::SampledBlock oldest;
    if (!ring.take(oldest)) {
      std::this_thread::yield();
      continue;
    }
    const bool is_whole = oldest.block.sequence == number && oldest.samples.size() == size_of(number) &&
                          std::ranges::all_of(oldest.samples, [number](float sample) { return sample == static_cast<float>(number); });
    if (!is_whole) ++wrong;
    ring.release();
    ++number;
  }
  putter.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace earshot::board
