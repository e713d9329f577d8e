#include "hil/bus/decode/fast_packets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
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

/// The same with frames a millisecond apart.
int whole_in_time(FastPackets& packets, const std::vector<std::uint8_t>& bytes, std::string_view order, Time begin = {}) {
  const auto frames = frames_of(bytes);
  int whole = 0;
  for (const char number : order) {
    const auto taken = packets.accept(kGnss, frames[static_cast<std::size_t>(number - '0')], begin);
    begin = begin + Duration::milliseconds(1);
    if (!taken) continue;
    EXPECT_EQ(taken->bytes, bytes);
    ++whole;
  }
  return whole;
}

TEST(FastPackets, TakeAFirstFrameHoweverLateItComes) {
  for (const char* order : {"1230456", "1234056", "1234506", "5640312", "6543210", "2134560", "6543012"}) {
    FastPackets packets;
    EXPECT_EQ(whole_in_time(packets, message(47), order), 1) << order;
    EXPECT_EQ(packets.incomplete(), 0U) << order;
  }
}

// Three or more frames in order up to the last and then a first one look as the end of one message and the begin of another do. Of 720
// orders of 6 frames that are 17: of 5 and two others, or three, or four, before the first, and the rest behind it in any order: 6 x 2 + 4
// + 1.
TEST(FastPackets, TakeFramesInEveryOrderButThoseThatTwoMessagesMayHave) {
  std::string order = "012345";
  int taken = 0;
  do {
    FastPackets packets;
    const std::string ahead = order.substr(0, order.find('0'));
    const bool may_be_two = ahead.size() > 2 && std::ranges::is_sorted(ahead) && ahead.back() == '5';
    const int whole = whole_in_time(packets, message(41), order);
    EXPECT_EQ(whole, may_be_two ? 0 : 1) << order;
    taken += whole;
  } while (std::ranges::next_permutation(order).found);
  EXPECT_EQ(taken, 720 - 17);
}

TEST(FastPackets, TakeNoLateFirstFrameThatMayBeAnothersByItsTime) {
  const auto bytes = message(47);
  const auto frames = frames_of(bytes);
  const auto is_taken_after = [&frames](std::optional<Time> before, std::optional<Time> then) {
    FastPackets packets;
    for (const std::size_t i : {2U, 1U, 3U, 4U, 5U, 6U}) EXPECT_FALSE(packets.accept(kGnss, frames[i], before));
    return packets.accept(kGnss, frames[0], then).has_value();
  };
  EXPECT_TRUE(is_taken_after(Time{}, Time{50'000}));
  EXPECT_FALSE(is_taken_after(Time{}, Time{50'001}));
  EXPECT_FALSE(is_taken_after(std::nullopt, std::nullopt)) << "nobody knows when they came";
}

// As in canboat's recombine-frames.in, where the second frame passes for the one before, which came again.
TEST(FastPackets, DoNotMixTwoMessagesWhenTheFirstTwoFramesOfOneAreLost) {
  FastPackets packets;
  EXPECT_EQ(whole_in_time(packets, message(47, 100), "23456"), 0);
  EXPECT_EQ(whole_in_time(packets, message(47), "0123456", Time{5'000}), 1);
  EXPECT_EQ(packets.incomplete(), 1U);
}

// The first of the one is lost and its last frames, too: the next one's first, which comes before its others, is not given up with them.
TEST(FastPackets, KeepAMessageBehindTheMiddleOfAnother) {
  FastPackets packets;
  EXPECT_EQ(whole_in_time(packets, message(47, 100), "123"), 0);
  const auto frames = frames_of(message(47));
  std::optional<FastPackets::Whole> whole;
  for (std::int64_t i = 0; i < 7; ++i) whole = packets.accept(kGnss, frames[static_cast<std::size_t>(i)], Time{3'000 + 1'000 * i});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->bytes, message(47));
  EXPECT_EQ(whole->began, Time{3'000});
  EXPECT_EQ(packets.incomplete(), 1U);
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
