#include "firmware/wire/n2k/codec.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace earshot::n2k {
namespace {

TEST(MessageWriter, LeavesWhatIsNotSetNotAvailable) {
  // 127250 = 0x1F112 at priority 2 from 0x07; a heading of 1 rad = 10000 = 0x2710; deviation and variation 0x7FFF, reference 3, six ones.
  Frame frame;
  ASSERT_EQ(MessageWriter(kHeadingPgn).set("Heading", 1.0).frame(7, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x09F11207, 8, {0xFF, 0x10, 0x27, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF}}));
}

TEST(MessageWriter, RemembersItsFirstRefusal) {
  MessageWriter writer(kHeadingPgn);
  writer.set("Heading", -1.0).set_text("Heading", "no text").set("Variation", 0.1);
  EXPECT_EQ(writer.status(), Status::kOutOfRange);
  Frame frame;
  EXPECT_EQ(writer.frame(7, frame), Status::kOutOfRange);
  EXPECT_EQ(frame, Frame{});
}

TEST(MessageWriter, MakesNoFrameForOneDeviceOfAGroupThatGoesToAll) {
  Frame frame;
  EXPECT_EQ(MessageWriter(kHeadingPgn).frame(7, frame, 0x23), Status::kOutOfRange);
  EXPECT_EQ(frame, Frame{});
}

TEST(MessageWriter, MakesNoFrameOfWhatNeedsSeveral) {
  Frame frame;
  EXPECT_EQ(MessageWriter(kDistanceLogPgn).frame(7, frame), Status::kOutOfRange);
}

TEST(MessageWriter, WritesNoBytesBehindAShortMessage) {
  Frame frame;
  frame.data.fill(0xAA);
  ASSERT_EQ(MessageWriter(kRequestPgn).set_raw("PGN", 0x01F112).frame(7, frame, 0x23), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x18EA2307, 3, {0x12, 0xF1, 0x01}}));
}

TEST(MessageReader, RemembersTheFirstFailureAndReadsZeroFromThenOn) {
  const std::array<std::uint8_t, 8> bytes{0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0xE8, 0x03, 0xFD};  // of all, a variation of 1000 * 1e-4 rad
  MessageReader reader(table::kHeading, bytes);
  EXPECT_EQ(reader.value("Variation"), 0.1);
  EXPECT_EQ(reader.status(), Status::kOk);
  EXPECT_EQ(reader.value("Heading"), 0.0);
  EXPECT_EQ(reader.status(), Status::kNotReady);
  EXPECT_EQ(reader.raw("Variation"), 0);
  MessageReader short_one(table::kHeading, std::span(bytes).first(2));
  EXPECT_EQ(short_one.raw("Heading"), 0);
  EXPECT_EQ(short_one.value("SID"), 0.0);
  EXPECT_EQ(short_one.status(), Status::kMalformed) << "not what came after it";
}

TEST(MessageReader, TakesOneForYesAndZeroForNo) {
  for (const std::uint8_t raw : {std::uint8_t{0}, std::uint8_t{1}}) {
    // Port 2, then the link in two bits; the reserved ones are one.
    const std::array<std::uint8_t, 4> bytes{0xFC, 0x9F, 2, static_cast<std::uint8_t>(0xFC | raw)};
    MessageReader reader(table::kPortHealth, bytes);
    EXPECT_EQ(reader.yes("LinkUp"), raw == 1);
    EXPECT_EQ(reader.status(), Status::kOk);
  }
}

TEST(Read, SaysWhatOneFieldOfAMessageSays) {
  const std::array<std::uint8_t, 8> bytes{0xFF, 0x10, 0x27, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD};
  EXPECT_EQ(read(kHeadingPgn, "Heading", bytes).value(), 1.0);
  EXPECT_EQ(read(kHeadingPgn, "Reference", bytes).value(), 1.0);
  EXPECT_EQ(read(kHeadingPgn, "Variation", bytes).status(), Status::kNotReady);
}

}  // namespace
}  // namespace earshot::n2k
