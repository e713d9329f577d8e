#include "hil/bus/decode/fast_packets.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string_view>

#include "firmware/wire/n2k/fast_packet.hpp"

namespace earshot::hil {
namespace {

constexpr n2k::Identifier kGnss{.pgn = 129029, .priority = 3, .source = 0, .destination = n2k::kBroadcast};

/// A message of so many bytes, which count up from `first`.
std::vector<std::uint8_t> message(std::size_t size, std::uint8_t first = 0) {
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) byte = first++;
  return bytes;
}

n2k::FastPacketFrames frames_of(const std::vector<std::uint8_t>& bytes, std::uint8_t sequence = 0) {
  n2k::FastPacketFrames frames;
  EXPECT_EQ(n2k::compose_fast_packet(kGnss, sequence, bytes, frames), Status::kOk);
  return frames;
}

/// Frames of one message by their numbers: how many become whole. A blank between two messages is for who reads it.
int whole_of(FastPackets& packets, const n2k::FastPacketFrames& frames, const std::vector<std::uint8_t>& bytes, std::string_view order) {
  int whole = 0;
  for (const char number : order) {
    if (number == ' ') continue;
    const auto taken = packets.accept(kGnss, frames[static_cast<std::size_t>(number - '0')], std::nullopt);
    if (!taken) continue;
    EXPECT_EQ(taken->bytes, bytes);
    ++whole;
  }
  return whole;
}

TEST(FastPackets, TakeFramesInAnyOrder) {
  const auto bytes = message(20);
  const auto frames = frames_of(bytes);
  for (const char* order : {"012", "021", "102", "120", "201", "210"}) {
    FastPackets packets;
    EXPECT_EQ(whole_of(packets, frames, bytes, order), 1) << order;
    EXPECT_EQ(packets.incomplete(), 0U) << order;
  }
}

// The order of canboat's recombine-frames.in, all of one sequence: 5 are whole, two of them swapped.
TEST(FastPackets, FindTheMessagesThatAGatewaySwappedAndLostFramesOf) {
  const auto bytes = message(47);
  FastPackets packets;
  EXPECT_EQ(whole_of(packets, frames_of(bytes), bytes, "0123456 0123456 0263451 026345 2063451 123456 0123456"), 5);
  EXPECT_EQ(packets.incomplete(), 2U);
}

// Of each of three messages of one sequence the first frame is lost: what is left must not go with the next one's first.
TEST(FastPackets, DoNotMixTwoMessagesWhenTheFirstFrameOfOneIsLost) {
  FastPackets packets;
  for (std::uint8_t nth = 0; nth < 3; ++nth) {
    const auto frames = frames_of(message(47, static_cast<std::uint8_t>(50 * nth)));
    for (std::size_t i = nth == 0 ? 1 : 0; i < frames.size(); ++i) {
      const auto whole = packets.accept(kGnss, frames[i], std::nullopt);
      EXPECT_EQ(whole.has_value(), nth > 0 && i + 1 == frames.size());
      if (whole) {
        EXPECT_EQ(whole->bytes, message(47, static_cast<std::uint8_t>(50 * nth)));
      }
    }
  }
  EXPECT_EQ(packets.incomplete(), 1U);
}

TEST(FastPackets, TakeALastFrameWithoutPaddingAndNoOtherShortOne) {
  const auto bytes = message(15);
  auto frames = frames_of(bytes);
  frames[2].size = 3;  // 15 = 6 + 7 + 2, and the number
  FastPackets packets;
  EXPECT_EQ(whole_of(packets, frames, bytes, "012"), 1);
  EXPECT_EQ(whole_of(packets, frames, bytes, "102"), 1);
  EXPECT_EQ(whole_of(packets, frames, bytes, "021"), 1);
  frames[2].size = 2;
  EXPECT_EQ(whole_of(packets, frames, bytes, "012"), 0);
  frames[2].size = 3;
  frames[1].size = 7;
  EXPECT_EQ(whole_of(packets, frames, bytes, "012"), 0);
  EXPECT_EQ(packets.incomplete(), 2U);
  const auto small = message(3);
  auto single = frames_of(small);
  single[0].size = 5;
  EXPECT_EQ(whole_of(packets, single, small, "00"), 2);
}

TEST(FastPackets, PassOverAFrameThatCameTwice) {
  const auto bytes = message(20);
  FastPackets packets;
  EXPECT_EQ(whole_of(packets, frames_of(bytes), bytes, "011222 01122 012"), 3);
  EXPECT_EQ(packets.incomplete(), 0U);
}

TEST(FastPackets, KeepSequencesGroupsAndDestinationsApart) {
  const auto bytes = message(20);
  const auto one = frames_of(bytes, 1);
  const auto two = frames_of(bytes, 2);
  const n2k::Identifier other{.pgn = 126996, .priority = 6, .source = 0, .destination = n2k::kBroadcast};
  FastPackets packets;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_last = i == 2;
    EXPECT_EQ(packets.accept(kGnss, one[i], std::nullopt).has_value(), is_last);
    EXPECT_EQ(packets.accept(kGnss, two[i], std::nullopt).has_value(), is_last);
    EXPECT_EQ(packets.accept(other, one[i], std::nullopt).has_value(), is_last);
  }
}

TEST(FastPackets, DoNotJoinFramesThatAreTooFarApart) {
  const auto frames = frames_of(message(10));
  FastPackets packets;
  EXPECT_FALSE(packets.accept(kGnss, frames[0], Time{0}));
  EXPECT_FALSE(packets.accept(kGnss, frames[1], Time{751'000}));
  EXPECT_FALSE(packets.accept(kGnss, frames[0], Time{2'000'000}));
  const auto whole = packets.accept(kGnss, frames[1], Time{2'750'000});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->began, Time{2'000'000});
}

TEST(FastPackets, RefuseSizesThatNoMessageHas) {
  FastPackets packets;
  for (const std::uint8_t size : {std::uint8_t{0}, std::uint8_t{224}})
    EXPECT_FALSE(packets.accept(kGnss, {.identifier = 0, .size = 8, .data = {0, size}}, std::nullopt));
  EXPECT_FALSE(packets.accept(kGnss, {.identifier = 0, .size = 0}, std::nullopt));
  EXPECT_FALSE(packets.accept(kGnss, {.identifier = 0, .size = 1}, std::nullopt));
  EXPECT_EQ(packets.incomplete(), 4U);
}

TEST(FastPackets, GiveUpTheOldestOfMoreThanTheyHold) {
  FastPackets packets;
  const auto frames = frames_of(message(10));
  const auto of = [](std::size_t i) {
    return n2k::Identifier{.pgn = static_cast<std::uint32_t>(130000 + i), .priority = 6, .source = 0, .destination = n2k::kBroadcast};
  };
  for (std::size_t i = 0; i <= FastPackets::kMostBegun; ++i) EXPECT_FALSE(packets.accept(of(i), frames[0], std::nullopt));
  EXPECT_EQ(packets.incomplete(), FastPackets::kMostBegun + 1);
  EXPECT_FALSE(packets.accept(of(0), frames[1], std::nullopt));
  EXPECT_TRUE(packets.accept(of(2), frames[1], std::nullopt));
}

// Random sizes, neighbours swapped at random, other messages between: every one is found.
TEST(FastPackets, FindEveryMessageWhoseNeighboursAreSwapped) {
  std::mt19937 dice(4);
  FastPackets packets;
  for (int i = 0; i < 2000; ++i) {
    const auto bytes = message(1 + dice() % n2k::kMaxMessageSize, static_cast<std::uint8_t>(dice()));
    auto frames = frames_of(bytes, static_cast<std::uint8_t>(i % 8));
    for (std::size_t k = 1; k < frames.size(); k += 2) {
      if (dice() % 2 == 0) std::swap(frames[k - 1], frames[k]);
    }
    int whole = 0;
    for (const n2k::Frame& frame : frames) {
      const auto taken = packets.accept(kGnss, frame, std::nullopt);
      whole += taken && taken->bytes == bytes ? 1 : 0;
    }
    ASSERT_EQ(whole, 1) << i;
  }
  EXPECT_EQ(packets.incomplete(), 0U);
}

}  // namespace
}  // namespace earshot::hil
