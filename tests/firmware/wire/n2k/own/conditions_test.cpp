#include "firmware/wire/n2k/own/conditions.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot::n2k {
namespace {

using Bytes = std::array<std::uint8_t, 8>;
constexpr std::uint8_t kSource = 0x40;

// Maker 2044, reserved ones, industry 4: 0x9FFC. Two bits each: 0 no, 1 yes, 2 error, 3 not available.

/// 65293: instance, then from bit 24: leak, ground fault, ones.
Bytes hull(std::uint8_t instance, std::uint8_t leak, std::uint8_t fault) {
  return {0xFC, 0x9F, instance, static_cast<std::uint8_t>(0xF0 | (fault << 2) | leak), 0xFF, 0xFF, 0xFF, 0xFF};
}

TEST(Conditions, AreLaidOutByteForByteAsTheTableSays) {
  Frame frame;
  // 65293 = 0xFF0D at priority 1.
  ASSERT_EQ(compose_hull({.instance = 2, .wet = true, .has_ground_fault = {}}, kSource, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x04FF0D40, 8, {0xFC, 0x9F, 0x02, 0xFD, 0xFF, 0xFF, 0xFF, 0xFF}}));
  ASSERT_EQ(compose_hull({.instance = 0, .wet = false, .has_ground_fault = true}, kSource, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x04FF0D40, 8, {0xFC, 0x9F, 0x00, 0xF4, 0xFF, 0xFF, 0xFF, 0xFF}}));
  // 65294 = 0xFF0E at priority 3.
  ASSERT_EQ(compose_autopilot_status({.follows_setpoints = true, .heading_sequence = 5}, kSource, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x0CFF0E40, 8, {0xFC, 0x9F, 0xFD, 0x05, 0xFF, 0xFF, 0xFF, 0xFF}}));
  ASSERT_EQ(compose_autopilot_status({.follows_setpoints = false, .heading_sequence = {}}, kSource, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x0CFF0E40, 8, {0xFC, 0x9F, 0xFC, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}}));
  // 65291 = 0xFF0B at priority 5, without an SNR; bits 60 and 61.
  ASSERT_EQ(compose_deaf(true, kSource, frame), Status::kOk);
  EXPECT_EQ(frame, (Frame{0x14FF0B40, 8, {0xFC, 0x9F, 0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xDF}}));
}

TEST(Conditions, OfAHullAreThoseThatItsDeviceWatches) {
  const Result<Hull> leak = read_hull(hull(2, 1, 3));
  ASSERT_TRUE(leak.ok());
  EXPECT_EQ(leak.value().instance, 2);
  EXPECT_EQ(leak.value().wet, true);
  EXPECT_FALSE(leak.value().has_ground_fault.has_value());
  const Result<Hull> fault = read_hull(hull(2, 3, 1));
  ASSERT_TRUE(fault.ok());
  EXPECT_FALSE(fault.value().wet.has_value());
  EXPECT_EQ(fault.value().has_ground_fault, true);
  const Result<Hull> sound = read_hull(hull(0, 0, 0));
  ASSERT_TRUE(sound.ok());
  EXPECT_EQ(sound.value().wet, false);
  EXPECT_EQ(sound.value().has_ground_fault, false);
}

TEST(Conditions, OfALeakHoldThoughItsSensorHasNoInstance) {
  const Result<Hull> leak = read_hull(hull(0xFF, 1, 3));
  ASSERT_TRUE(leak.ok());
  EXPECT_FALSE(leak.value().instance.has_value());
  EXPECT_EQ(leak.value().wet, true);
}

TEST(Conditions, ThatSayErrorAreNeitherYesNorNo) {
  EXPECT_EQ(read_hull(hull(0, 2, 3)).status(), Status::kOutOfRange);
  EXPECT_EQ(read_hull(hull(0, 3, 2)).status(), Status::kOutOfRange);
  EXPECT_FALSE(read_hull(hull(0, 1, 2)).value().has_ground_fault.has_value()) << "the leak counts all the same";
  EXPECT_EQ(read_autopilot_status(Bytes{0xFC, 0x9F, 0xFE, 5, 0xFF, 0xFF, 0xFF, 0xFF}).status(), Status::kOutOfRange);
  EXPECT_EQ(read_deaf(Bytes{0xFC, 0x9F, 0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xEF}).status(), Status::kOutOfRange);
}

TEST(Conditions, ThatAreNotAvailableSayNothing) {
  EXPECT_EQ(read_hull(hull(0, 3, 3)).status(), Status::kNotReady);
  EXPECT_EQ(read_autopilot_status(Bytes{0xFC, 0x9F, 0xFF, 5, 0xFF, 0xFF, 0xFF, 0xFF}).status(), Status::kNotReady);
  EXPECT_EQ(read_deaf(Bytes{0xFC, 0x9F, 0xBB, 0xFE, 0x27, 0x42, 0xF2, 0xFF}).status(), Status::kNotReady) << "with an SNR";
}

TEST(Conditions, OfAnAutopilotAndAHydrophoneComeBack) {
  const Result<AutopilotCondition> follows = read_autopilot_status(Bytes{0xFC, 0x9F, 0xFD, 5, 0xFF, 0xFF, 0xFF, 0xFF});
  ASSERT_TRUE(follows.ok());
  EXPECT_TRUE(follows.value().follows_setpoints);
  EXPECT_EQ(follows.value().heading_sequence, 5);
  const Result<AutopilotCondition> by_hand = read_autopilot_status(Bytes{0xFC, 0x9F, 0xFC, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  ASSERT_TRUE(by_hand.ok());
  EXPECT_FALSE(by_hand.value().follows_setpoints);
  EXPECT_FALSE(by_hand.value().heading_sequence.has_value());
  EXPECT_TRUE(read_deaf(Bytes{0xFC, 0x9F, 0xBB, 0xFE, 0x27, 0x42, 0xF2, 0xDF}).value());
  EXPECT_FALSE(read_deaf(Bytes{0xFC, 0x9F, 0xBB, 0xFE, 0x27, 0x42, 0xF2, 0xCF}).value());
}

TEST(Conditions, OfOtherMakersAreNotTaken) {
  Bytes stranger = hull(0, 1, 1);
  stranger[0] = 0xFB;
  EXPECT_EQ(read_hull(stranger).status(), Status::kUnsupported);
  EXPECT_EQ(read_autopilot_status(stranger).status(), Status::kUnsupported);
  EXPECT_EQ(read_deaf(stranger).status(), Status::kUnsupported);
  EXPECT_EQ(read_hull(std::span(stranger).first(1)).status(), Status::kUnsupported);
}

TEST(Conditions, OfAFrameThatEndsBeforeThemAreMalformed) {
  const Bytes wet = hull(0, 1, 3);
  EXPECT_EQ(read_hull(std::span(wet).first(3)).status(), Status::kMalformed);
}

}  // namespace
}  // namespace earshot::n2k
