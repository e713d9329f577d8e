#include "firmware/wire/n2k/setpoint.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace earshot::n2k {
namespace {

constexpr std::uint8_t kAddress = 44;
const messages::Setpoint kSetpoint{.heading = Radians{2.3152}, .speed = MetersPerSecond{2.0}, .depth = Meters{300.0}, .waypoint = {}};

SetpointFrames frames_of(const messages::Setpoint& setpoint, std::uint8_t sequence = 3) {
  SetpointFrames frames;
  EXPECT_EQ(compose_setpoint(setpoint, kAddress, sequence, frames), Status::kOk);
  return frames;
}

TEST(Setpoint, IsLaidOutByteForByteAsTheStandardSays) {
  const SetpointFrames frames = frames_of(kSetpoint);
  ASSERT_EQ(frames.size(), 5U);
  // 65290 = 0xFF0A at priority 3. Manufacturer 2044, two reserved ones, industry 4: 0x9FFC; 200 * 0.01 m/s; 30000 * 0.01 m = 0x007530; the
  // heading's sequence, 3.
  EXPECT_EQ(frames[0], (Frame{0x0CFF0A2C, 8, {0xFC, 0x9F, 0xC8, 0x00, 0x30, 0x75, 0x00, 0x03}}));
  // 127237 = 0x1F105 at priority 2, sequence 3. Heading control (4), true: bits 8..15 are 100 111 00 from below: 0x3C. Heading 23152 =
  // 0x5A70.
  EXPECT_EQ(frames[1], (Frame{0x09F1052C, 8, {0x60, 21, 0xFF, 0x3C, 0xFF, 0xFF, 0x7F, 0x70}}));
  EXPECT_EQ(frames[2], (Frame{0x09F1052C, 8, {0x61, 0x5A, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}}));
  EXPECT_EQ(frames[3], (Frame{0x09F1052C, 8, {0x62, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF}}));
  EXPECT_EQ(frames[4], (Frame{0x09F1052C, 8, {0x63, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}}));
}

// The last byte: the sequence, 3, in its lower half; in the upper one 0 for No, 1 for Yes.
TEST(Setpoint, AsksForTheDropWeightInTheHalfByteAboveTheSequence) {
  messages::Setpoint release = kSetpoint;
  release.release_weight = true;
  EXPECT_EQ(frames_of(release)[0], (Frame{0x0CFF0A2C, 8, {0xFC, 0x9F, 0xC8, 0x00, 0x30, 0x75, 0x00, 0x13}}));
  EXPECT_EQ(frames_of(kSetpoint)[0].data[7], 0x03);
}

TEST(Setpoint, ReleasesTheWeightOnlyWhereItSaysYes) {
  for (unsigned half = 0; half <= 15; ++half) {
    SetpointFrames frames = frames_of(kSetpoint);
    frames[0].data[7] = static_cast<std::uint8_t>(half << 4U | 3U);
    SetpointReceiver receiver;
    messages::Setpoint received;
    Status status = Status::kNotReady;
    for (const Frame& frame : frames) status = receiver.accept(frame, received);
    EXPECT_EQ(status, Status::kOk) << half;
    EXPECT_EQ(received.release_weight, half == 1) << half;
  }
}

TEST(Setpoint, ComesBackToTheResolutionOfTheFrames) {
  for (const double heading : {-3.1, -0.00001, 0.0, 1.2345678, 3.14}) {
    SetpointReceiver receiver;
    messages::Setpoint received;
    Status status = Status::kNotReady;
    for (const Frame& frame :
         frames_of({.heading = Radians{heading}, .speed = MetersPerSecond{1.234}, .depth = Meters{300.007}, .waypoint = {}})) {
      EXPECT_EQ(status, Status::kNotReady);
      status = receiver.accept(frame, received);
    }
    ASSERT_EQ(status, Status::kOk);
    EXPECT_NEAR(received.heading.value, heading,
                0.6e-4);  // half of 1e-4 rad; and near north, what a whole turn is not a whole number of 1e-4 rad
    EXPECT_NEAR(received.speed.value, 1.234, 0.005);    // half of 0.01 m/s
    EXPECT_NEAR(received.depth.value, 300.007, 0.005);  // half of 0.01 m
  }
}

TEST(Setpoint, OfAnotherMakersOrAnotherIndustrysGroupIsNotTaken) {
  // Bytes 0 and 1 from below: maker 2044 in 11 bits, two reserved ones, industry 4 in 3: 0x9FFC.
  struct Head {
    std::uint8_t low, high;
    const char* what;
  };
  for (const Head& head : {Head{0xFB, 0x9F, "maker 2043"}, Head{0xFC, 0x9B, "maker 1020"}, Head{0xFC, 0x1F, "industry 0"},
                           Head{0xFC, 0xBF, "industry 5"}, Head{0xFF, 0x9F, "no maker"}, Head{0xFC, 0xFF, "no industry"}}) {
    SetpointFrames frames = frames_of(kSetpoint);
    frames[0].data[0] = head.low;
    frames[0].data[1] = head.high;
    SetpointReceiver receiver;
    messages::Setpoint received;
    for (const Frame& frame : frames) EXPECT_EQ(receiver.accept(frame, received), Status::kNotReady) << head.what;
  }
  SetpointFrames frames = frames_of(kSetpoint);
  SetpointReceiver receiver;
  messages::Setpoint received;
  frames[0].size = 1;
  for (const Frame& frame : frames) EXPECT_EQ(receiver.accept(frame, received), Status::kNotReady) << "cut short";
}

TEST(Setpoint, IsTakenWhateverItsReservedBitsSay) {
  for (const std::uint8_t high : {std::uint8_t{0x87}, std::uint8_t{0x8F}, std::uint8_t{0x97}}) {  // bits 11 and 12; 0x9F has both
    SetpointFrames frames = frames_of(kSetpoint);
    frames[0].data[1] = high;
    SetpointReceiver receiver;
    messages::Setpoint received;
    Status status = Status::kNotReady;
    for (const Frame& frame : frames) status = receiver.accept(frame, received);
    EXPECT_EQ(status, Status::kOk) << int{high};
  }
}

TEST(Setpoint, WithAMagneticHeadingIsRefused) {
  SetpointFrames frames = frames_of(kSetpoint);
  frames[1].data[3] = 0x7C;  // the reference, bits 14 and 15 of the message: 1 for magnetic where 0x3C has 0 for true
  SetpointReceiver receiver;
  messages::Setpoint received;
  Status status = Status::kNotReady;
  for (const Frame& frame : frames) status = receiver.accept(frame, received);
  EXPECT_EQ(status, Status::kUnsupported);
}

TEST(Setpoint, WithoutAHeadingOrAReferenceIsRefused) {
  for (const bool without_heading : {true, false}) {
    SetpointFrames frames = frames_of(kSetpoint);
    if (without_heading) {
      frames[1].data[7] = 0xFF;
      frames[2].data[1] = 0xFF;
    } else {
      frames[1].data[3] = 0xFC;
    }
    SetpointReceiver receiver;
    messages::Setpoint received;
    Status status = Status::kNotReady;
    for (const Frame& frame : frames) status = receiver.accept(frame, received);
    EXPECT_EQ(status, Status::kOutOfRange);
  }
}

TEST(Setpoint, IsNotMadeOfADepthThatWasTakenBack) {
  const SetpointFrames frames = frames_of(kSetpoint);
  Frame nonsense = frames[0];
  nonsense.data[7] = 0x08;  // a fast packet counts from 0 to 7
  SetpointReceiver receiver;
  messages::Setpoint received;
  EXPECT_EQ(receiver.accept(frames[0], received), Status::kNotReady);
  EXPECT_EQ(receiver.accept(nonsense, received), Status::kOutOfRange);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_EQ(receiver.accept(frames[i], received), Status::kNotReady);
}

TEST(Setpoint, IsNeverMadeOfHalvesOfTwo) {
  const SetpointFrames frames = frames_of(kSetpoint);
  SetpointReceiver receiver;
  messages::Setpoint received;
  for (const Frame& frame : frames) static_cast<void>(receiver.accept(frame, received));
  // Of the next one, speed and depth are lost: its heading alone is none.
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_EQ(receiver.accept(frames[i], received), Status::kNotReady);
  // Of the one after, a part of the heading is lost.
  for (const std::size_t i : {0U, 1U, 2U}) EXPECT_EQ(receiver.accept(frames[i], received), Status::kNotReady);
  EXPECT_EQ(receiver.accept(frames[4], received), Status::kMalformed);
}

TEST(Setpoint, IsNotMadeOfAnOldDepthAndANewHeadingWhateverIsLostBetweenThem) {
  // Of the old one, the heading is lost; of the new one, speed and depth.
  const SetpointFrames old = frames_of(kSetpoint, 6);
  const SetpointFrames fresh = frames_of({.heading = Radians{1}, .speed = MetersPerSecond{2.0}, .depth = Meters{100}, .waypoint = {}}, 7);
  SetpointReceiver receiver;
  messages::Setpoint received;
  EXPECT_EQ(receiver.accept(old[0], received), Status::kNotReady);
  for (std::size_t i = 1; i < fresh.size(); ++i) EXPECT_EQ(receiver.accept(fresh[i], received), Status::kNotReady);
  // The next one comes whole; its sequence is 8, which a fast packet counts as 0.
  Status status = Status::kNotReady;
  for (const Frame& frame : frames_of(kSetpoint, 8)) status = receiver.accept(frame, received);
  EXPECT_EQ(status, Status::kOk);
  EXPECT_NEAR(received.depth.value, 300.0, 0.005);  // half of 0.01 m
}

TEST(Setpoint, TakesNoHeadingOfAnotherDevice) {
  const SetpointFrames frames = frames_of(kSetpoint);
  SetpointReceiver receiver;
  messages::Setpoint received;
  EXPECT_EQ(receiver.accept(frames[0], received), Status::kNotReady);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    Frame others = frames[i];
    others.identifier += 1;
    EXPECT_EQ(receiver.accept(others, received), Status::kNotReady);
  }
  Status status = Status::kNotReady;
  for (std::size_t i = 1; i < frames.size(); ++i) status = receiver.accept(frames[i], received);
  EXPECT_EQ(status, Status::kOk) << "ours still has its depth";
}

TEST(Setpoint, IsNotMadeOfADepthThatNamesNoHeading) {
  SetpointFrames frames = frames_of(kSetpoint);
  frames[0].data[7] = 0xFF;  // not available
  SetpointReceiver receiver;
  messages::Setpoint received;
  EXPECT_EQ(receiver.accept(frames[0], received), Status::kOutOfRange);
  for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_EQ(receiver.accept(frames[i], received), Status::kNotReady);
}

TEST(Setpoint, IsRefusedWhenNoFrameCanCarryIt) {
  SetpointFrames frames;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(
      compose_setpoint({.heading = Radians{nan}, .speed = MetersPerSecond{2}, .depth = Meters{300}, .waypoint = {}}, kAddress, 0, frames),
      Status::kOutOfRange);
  EXPECT_EQ(
      compose_setpoint({.heading = Radians{0}, .speed = MetersPerSecond{-1}, .depth = Meters{300}, .waypoint = {}}, kAddress, 0, frames),
      Status::kOutOfRange);
  EXPECT_EQ(
      compose_setpoint({.heading = Radians{0}, .speed = MetersPerSecond{2}, .depth = Meters{nan}, .waypoint = {}}, kAddress, 0, frames),
      Status::kOutOfRange);
  EXPECT_TRUE(frames.empty());
}

}  // namespace
}  // namespace earshot::n2k
