#include "firmware/wire/n2k/fast_packet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <vector>

#include "firmware/wire/n2k/table/messages.hpp"
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
  EXPECT_EQ(compose_fast_packet({.pgn = 0x40000}, 0, counting(9), frames), Status::kOutOfRange) << "no such group";
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

TEST_F(FastPacket, LosesNothingByFramesCutShort) {
  const auto frames = frames_of(counting(21));
  EXPECT_EQ(accept(frames[0]), Status::kNotReady);
  for (Frame cut = frames[1]; cut.size-- > 0;) EXPECT_EQ(accept(cut), Status::kMalformed) << int{cut.size};
  EXPECT_EQ(assembly_.counters().stray, 8U);
  EXPECT_EQ(assembly_.counters().abandoned, 0U);
  EXPECT_EQ(accept(frames[1]), Status::kNotReady);
  EXPECT_EQ(accept(frames[2]), Status::kNotReady);
  ASSERT_EQ(accept(frames[3]), Status::kOk);
  EXPECT_EQ(bytes(), counting(21));
  Frame first = frames[0];
  first.size = 7;
  EXPECT_EQ(accept(first), Status::kMalformed);
  EXPECT_EQ(accept(frames[1]), Status::kMalformed) << "a first frame cut short begins nothing";
}

TEST_F(FastPacket, IsHandedOutOnceThoughItsFramesComeTwice) {
  const auto frames = frames_of(counting(21));
  for (const std::size_t i : {0U, 0U, 1U, 1U, 1U, 2U, 2U}) EXPECT_EQ(accept(frames[i]), Status::kNotReady);
  ASSERT_EQ(accept(frames[3]), Status::kOk);
  EXPECT_EQ(bytes(), counting(21));
  EXPECT_EQ(accept(frames[3]), Status::kMalformed) << "the last one again";
  EXPECT_EQ(assembly_.counters().completed, 1U);
  EXPECT_EQ(assembly_.counters().abandoned, 1U) << "a first frame that came twice began the message anew";
  EXPECT_EQ(assembly_.counters().repeated, 3U);
  EXPECT_EQ(assembly_.counters().stray, 1U);
  EXPECT_EQ(assembly_.counters().too_large, 0U);
}

TEST_F(FastPacket, KeepsDestinationsAndGroupsApart) {
  constexpr Identifier kToUs{.pgn = kPeerPgn, .priority = 3, .source = 9, .destination = 0x40};
  Identifier to_another = kToUs;
  to_another.destination = 0x41;
  Identifier other_group = kToUs;
  other_group.pgn = kGroupFunctionPgn;
  for (const Identifier& other : {to_another, other_group}) {
    const auto mine = frames_of(counting(13), 0, kToUs);
    const auto theirs = frames_of(Bytes(13, 0xEE), 0, other);
    EXPECT_EQ(accept(mine[0], kToUs), Status::kNotReady);
    EXPECT_EQ(accept(mine[1], other), Status::kMalformed) << "it goes on with nothing there";
    EXPECT_EQ(accept(theirs[0], other), Status::kNotReady);
    ASSERT_EQ(accept(mine[1], kToUs), Status::kOk);
    EXPECT_EQ(bytes(), counting(13));
    ASSERT_EQ(accept(theirs[1], other), Status::kOk);
    EXPECT_EQ(bytes(), Bytes(13, 0xEE));
  }
}

TEST_F(FastPacket, IsAbandonedWhenItsSenderBeginsOneThatIsTooLarge) {
  const auto frames = frames_of(counting(9));
  EXPECT_EQ(accept(frames[0]), Status::kNotReady);
  Frame too_large = frames[0];
  too_large.data[1] = 224;
  EXPECT_EQ(accept(too_large), Status::kFull);
  EXPECT_EQ(accept(frames[1]), Status::kMalformed);
  EXPECT_EQ(assembly_.counters().abandoned, 1U);
  EXPECT_EQ(assembly_.counters().stray, 1U);
  EXPECT_EQ(assembly_.counters().too_large, 1U);
}

TEST_F(FastPacket, IsGivenUpByWhenItsLastFrameCameAndNotByWhenItBegan) {
  const auto sender = [](std::size_t i) {
    return Identifier{.pgn = kHeadingControlPgn, .priority = 2, .source = static_cast<std::uint8_t>(i)};
  };
  const auto frames = frames_of(counting(20));
  for (std::size_t i = 0; i < config::kFastPacketSlots; ++i) EXPECT_EQ(accept(frames[0], sender(i)), Status::kNotReady);
  EXPECT_EQ(accept(frames[1], sender(0)), Status::kNotReady);
  EXPECT_EQ(accept(frames[0], sender(100)), Status::kNotReady) << "in the place of 1, whose frame is the oldest by now";
  EXPECT_EQ(assembly_.counters().abandoned, 1U);
  EXPECT_EQ(accept(frames[1], sender(1)), Status::kMalformed);
  ASSERT_EQ(accept(frames[2], sender(0)), Status::kOk);
  // 0 has a place again, and its message is the youngest; that of 2 is the oldest.
  for (std::size_t i = 2; i < config::kFastPacketSlots; ++i) EXPECT_EQ(accept(frames[1], sender(i)), Status::kNotReady);
  EXPECT_EQ(accept(frames[1], sender(100)), Status::kNotReady);
  EXPECT_EQ(accept(frames[0], sender(0)), Status::kNotReady);
  EXPECT_EQ(accept(frames[0], sender(101)), Status::kNotReady);
  EXPECT_EQ(accept(frames[2], sender(2)), Status::kMalformed);
  EXPECT_EQ(accept(frames[1], sender(0)), Status::kNotReady);
  EXPECT_EQ(accept(frames[2], sender(0)), Status::kOk);
}

TEST_F(FastPacket, IsAbandonedWhenAFrameComesOver750MillisecondsAfterTheOneBeforeIt) {
  const auto frames = frames_of(counting(20));
  constexpr Time kFirst{1'000'000};
  Assembled message;
  EXPECT_EQ(assembly_.accept(kControl, frames[0], kFirst, message), Status::kNotReady);
  EXPECT_EQ(assembly_.accept(kControl, frames[1], kFirst + Duration::milliseconds(750), message), Status::kNotReady);
  ASSERT_EQ(assembly_.accept(kControl, frames[2], kFirst + Duration::milliseconds(1500), message), Status::kOk);
  EXPECT_EQ(message.began, kFirst);
  EXPECT_EQ(assembly_.accept(kControl, frames[0], kFirst, message), Status::kNotReady);
  EXPECT_EQ(assembly_.accept(kControl, frames[1], kFirst + Duration{750'001}, message), Status::kMalformed);
}

TEST_F(FastPacket, SaysWhichFrameWouldGoOnWithAMessage) {
  const auto frames = frames_of(counting(20), 3);
  EXPECT_FALSE(assembly_.expects(kControl, frames[1]));
  EXPECT_EQ(accept(frames[0]), Status::kNotReady);
  EXPECT_TRUE(assembly_.expects(kControl, frames[1]));
  EXPECT_FALSE(assembly_.expects(kControl, frames[2]));
  EXPECT_FALSE(assembly_.expects(kControl, frames_of(counting(20), 4)[1])) << "of another sequence";
  Identifier other = kControl;
  other.source = 9;
  EXPECT_FALSE(assembly_.expects(other, frames[1]));
  EXPECT_EQ(accept(frames[1]), Status::kNotReady);
  EXPECT_EQ(accept(frames[2]), Status::kOk);
  EXPECT_FALSE(assembly_.expects(kControl, frames[2]));
}

TEST_F(FastPacket, SurvivesAMillionRandomFramesAndGivesOutOnlyWhatItsSendersSent) {
  constexpr std::size_t kSenders = 12;
  const auto sender = [](std::size_t i) { return Identifier{.pgn = kHeadingControlPgn, .source = static_cast<std::uint8_t>(i)}; };
  std::mt19937 random(1);
  // What each has sent since it last began a message. A frame that came twice in a row counts once.
  std::array<std::vector<Frame>, kSenders> sent;
  std::uint64_t completed = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    Frame frame{.identifier = 0x09F105AC, .size = static_cast<std::uint8_t>(random() % 16 == 0 ? random() % 8 : 8)};
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random());
    if (random() % 2 == 0) frame.data = {static_cast<std::uint8_t>(random() % 5), 21, 3, 4, 5, 6, 7, 8};
    const std::size_t which = random() % kSenders;
    std::vector<Frame>& frames = sent[which];
    const bool is_first = (frame.data[0] & 0x1FU) == 0;
    if (frame.size == 8 && is_first) frames.clear();
    if (frame.size == 8 && (is_first || frames.size() < 2 || frames.back() != frame)) frames.push_back(frame);
    if (accept(frame, sender(which)) != Status::kOk) continue;
    ++completed;
    Bytes expected;
    for (std::size_t number = 0; number < frames.size(); ++number) {
      ASSERT_EQ(frames[number].data[0] & 0x1FU, number) << "one is missing or out of order";
      ASSERT_EQ(frames[number].data[0] >> 5U, frames[0].data[0] >> 5U) << "of another message";
      expected.insert(expected.end(), frames[number].data.begin() + (number == 0 ? 2 : 1), frames[number].data.end());
    }
    ASSERT_GE(expected.size(), frames[0].data[1]);
    expected.resize(frames[0].data[1]);
    ASSERT_EQ(bytes(), expected);
  }
  EXPECT_GT(completed, 300U);
  EXPECT_EQ(assembly_.counters().completed, completed);
  for (std::size_t i = 0; i < kSenders; ++i) {
    Status status = Status::kNotReady;
    for (const Frame& frame : frames_of(counting(kMaxMessageSize))) status = accept(frame, sender(i));
    ASSERT_EQ(status, Status::kOk) << "it still receives, from " << i;
    EXPECT_EQ(bytes(), counting(kMaxMessageSize));
  }
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
