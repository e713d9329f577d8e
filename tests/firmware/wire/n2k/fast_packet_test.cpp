#include "firmware/wire/n2k/fast_packet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "tests/firmware/wire/n2k/recorded_bus.hpp"

namespace earshot::n2k {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr Identifier kControl{.pgn = kHeadingControlPgn, .priority = 2, .source = 172};

Bytes counting(std::size_t size) {
  Bytes bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
  return bytes;
}

FastPacketFrames frames_of(const Bytes& bytes, std::uint8_t sequence = 0, const Identifier& identifier = kControl) {
  FastPacketFrames frames;
  EXPECT_EQ(compose_fast_packet(identifier, sequence, bytes, frames), Status::kOk);
  return frames;
}

class FastPacket : public ::testing::Test {
 protected:
  Status accept(const Frame& frame, const Identifier& identifier = kControl) { return assembly_.accept(identifier, frame, bytes_); }
  [[nodiscard]] Bytes bytes() const { return {bytes_.begin(), bytes_.end()}; }

  FastPacketAssembly assembly_;
  std::span<const std::uint8_t> bytes_;
};

TEST_F(FastPacket, IsCutIntoTheVeryFramesOfARecordedBus) {
  int compared = 0;
  for (const Recorded& recorded : recorded_bus()) {
    if (recorded.frames.size() == 1) continue;
    for (const Frame& frame : recorded.frames) static_cast<void>(accept(frame));
    const Identifier identifier = parse_identifier(recorded.frames[0].identifier).value();
    const FastPacketFrames frames = frames_of(bytes(), static_cast<std::uint8_t>(recorded.frames[0].data[0] >> 5U), identifier);
    EXPECT_TRUE(std::ranges::equal(frames, recorded.frames));
    ++compared;
  }
  EXPECT_EQ(compared, 4);
}

TEST_F(FastPacket, GivesBackMessagesOfEverySize) {
  for (std::size_t size = 1; size <= kMaxMessageSize; ++size) {
    Status status = Status::kNotReady;
    for (const Frame& frame : frames_of(counting(size))) {
      ASSERT_EQ(status, Status::kNotReady);
      status = accept(frame);
    }
    ASSERT_EQ(status, Status::kOk) << size;
    EXPECT_EQ(bytes(), counting(size));
  }
}

TEST_F(FastPacket, RefusesToComposeNothingAndWhatNoPacketHolds) {
  FastPacketFrames frames;
  EXPECT_EQ(compose_fast_packet(kControl, 0, counting(0), frames), Status::kOutOfRange);
  EXPECT_EQ(compose_fast_packet(kControl, 0, counting(kMaxMessageSize + 1), frames), Status::kOutOfRange);
}

TEST_F(FastPacket, IsAbandonedWhenAFrameIsMissing) {
  const auto frames = frames_of(counting(21));
  EXPECT_EQ(accept(frames[0]), Status::kNotReady);
  EXPECT_EQ(accept(frames[2]), Status::kMalformed);
  EXPECT_EQ(accept(frames[3]), Status::kMalformed);
  EXPECT_EQ(assembly_.counters().abandoned, 1U);
  EXPECT_EQ(assembly_.counters().stray, 1U);
}

TEST_F(FastPacket, NeverMixesTwoMessagesOfOneSender) {
  const auto first = frames_of(counting(21), 1);
  const auto second = frames_of(Bytes(21, 0xEE), 2);
  EXPECT_EQ(accept(first[0]), Status::kNotReady);
  EXPECT_EQ(accept(second[1]), Status::kMalformed);
  EXPECT_EQ(accept(first[1]), Status::kMalformed) << "abandoned with the frame that did not belong";
}

TEST_F(FastPacket, KeepsSendersApart) {
  Identifier other = kControl;
  other.source = 9;
  const auto mine = frames_of(counting(21));
  const auto theirs = frames_of(Bytes(21, 0xEE), 0, other);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(accept(mine[i]), Status::kNotReady);
    EXPECT_EQ(accept(theirs[i], other), Status::kNotReady);
  }
  ASSERT_EQ(accept(mine[3]), Status::kOk);
  EXPECT_EQ(bytes(), counting(21));
  ASSERT_EQ(accept(theirs[3], other), Status::kOk);
  EXPECT_EQ(bytes(), Bytes(21, 0xEE));
}

TEST_F(FastPacket, GivesUpTheMessageThatWaitedLongestWhenAllSlotsAreTaken) {
  std::vector<Identifier> senders;
  for (std::size_t i = 0; i <= config::kFastPacketSlots; ++i)
    senders.push_back({.pgn = kHeadingControlPgn, .priority = 2, .source = static_cast<std::uint8_t>(i)});
  for (const Identifier& sender : senders) EXPECT_EQ(accept(frames_of(counting(9), 0, sender)[0], sender), Status::kNotReady);
  EXPECT_EQ(accept(frames_of(counting(9), 0, senders[0])[1], senders[0]), Status::kMalformed);
  EXPECT_EQ(accept(frames_of(counting(9), 0, senders[1])[1], senders[1]), Status::kOk);
}

TEST_F(FastPacket, DropsMessagesLargerThanAnyWithoutTouchingMemory) {
  Frame frame = frames_of(counting(21))[0];
  frame.data[1] = 224;
  EXPECT_EQ(accept(frame), Status::kFull);
  frame.data[1] = 0;
  EXPECT_EQ(accept(frame), Status::kFull);
  EXPECT_EQ(assembly_.counters().too_large, 2U);
}

TEST_F(FastPacket, SurvivesAMillionRandomFrames) {
  std::mt19937 random(1);
  for (int i = 0; i < 1'000'000; ++i) {
    Frame frame{.identifier = 0x09F105AC, .size = static_cast<std::uint8_t>(random() % 16 == 0 ? random() % 8 : 8)};
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random());
    if (random() % 2 == 0) frame.data = {static_cast<std::uint8_t>(random() % 5), 21, 3, 4, 5, 6, 7, 8};
    const Status status = accept(frame, {.pgn = kHeadingControlPgn, .source = static_cast<std::uint8_t>(random() % 12)});
    ASSERT_TRUE(status != Status::kOk || bytes_.size() <= kMaxMessageSize);
  }
  EXPECT_GT(assembly_.counters().completed, 0U);
}

TEST_F(FastPacket, NumbersItsMessagesFromZeroToSevenHoweverManyThereAre) {
  // The sequence is the three highest bits of a frame's first byte; the frame's own number is below.
  EXPECT_EQ(frames_of(counting(20), 7)[1].data[0], 0xE1);
  EXPECT_EQ(frames_of(counting(20), 8)[1].data[0], 0x01);
  EXPECT_EQ(frames_of(counting(20), 255)[1].data[0], 0xE1);
  for (unsigned sequence = 250; sequence < 260; ++sequence) {
    const FastPacketFrames frames = frames_of(counting(20), static_cast<std::uint8_t>(sequence));
    EXPECT_EQ(accept(frames[0]), Status::kNotReady);
    EXPECT_EQ(accept(frames[1]), Status::kNotReady);
    ASSERT_EQ(accept(frames[2]), Status::kOk) << sequence;
    EXPECT_EQ(bytes(), counting(20));
  }
}

}  // namespace
}  // namespace earshot::n2k
