#include "firmware/wire/n2k/navigation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/wire/n2k/codec.hpp"

namespace earshot::n2k {
namespace {

constexpr Time kNow{1'000'000'000};
constexpr std::uint8_t kSource = 7;

const LocalPlane kPlane = LocalPlane::about({46.0, -1.3}).value();
const messages::Navigation kNavigation{.time = {},
                                       .position = {Meters{12'345.678}, Meters{-321.0}},
                                       .depth = Meters{300.0},
                                       .heading = Radians{-1.5},
                                       .speed = MetersPerSecond{2.0}};

NavigationFrames frames_of(const messages::Navigation& navigation) {
  NavigationFrames frames;
  EXPECT_EQ(compose_navigation(navigation, kPlane, kSource, frames), Status::kOk);
  return frames;
}

class NavigationReceiverTest : public ::testing::Test {
 protected:
  Status accept(const Frame& frame, Time now = kNow) { return receiver_.accept(frame, now, navigation_); }

  NavigationReceiver receiver_{kPlane};
  messages::Navigation navigation_;
};

TEST_F(NavigationReceiverTest, GivesBackWhatWasComposedToTheResolutionOfTheFrames) {
  const NavigationFrames frames = frames_of(kNavigation);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames[i]), Status::kNotReady);
  ASSERT_EQ(accept(frames[3]), Status::kOk);
  EXPECT_NEAR(navigation_.position.north.value, 12'345.678, 0.0056);  // half of 1e-7 degree: 5.56 mm of latitude
  EXPECT_NEAR(navigation_.position.east.value, -321.0, 0.0056);
  EXPECT_NEAR(navigation_.depth.value, 300.0, 5e-6);     // half of 0.1 Pa
  EXPECT_NEAR(navigation_.heading.value, -1.5, 0.5e-4);  // half of 1e-4 rad
  EXPECT_NEAR(navigation_.speed.value, 2.0, 1e-12);      // a whole number of 0.01 m/s
}

TEST_F(NavigationReceiverTest, SendsTheMessagesWithTheirPgnsAndSource) {
  const NavigationFrames frames = frames_of(kNavigation);
  const std::array<std::uint32_t, 4> pgns{127250, 128259, 130314, 129025};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(parse_identifier(frames[i].identifier).value().pgn, pgns[i]);
    EXPECT_EQ(parse_identifier(frames[i].identifier).value().source, kSource);
    EXPECT_EQ(frames[i].size, 8);
  }
}

TEST_F(NavigationReceiverTest, WaitsUntilHeadingSpeedAndPressureHaveCome) {
  const NavigationFrames frames = frames_of(kNavigation);
  EXPECT_EQ(accept(frames[3]), Status::kStale);
  EXPECT_EQ(accept(frames[0]), Status::kNotReady);
  EXPECT_EQ(accept(frames[1]), Status::kNotReady);
  EXPECT_EQ(accept(frames[3]), Status::kStale);
  EXPECT_EQ(accept(frames[2]), Status::kNotReady);
  EXPECT_EQ(accept(frames[3]), Status::kOk);
  EXPECT_EQ(receiver_.counters().waiting, 2U);
}

TEST_F(NavigationReceiverTest, DoesNotUseADepthOlderThanItsTimeout) {
  const NavigationFrames frames = frames_of(kNavigation);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames[i]), Status::kNotReady);
  const Time edge = kNow + find_message(kPressurePgn)->timeout;
  EXPECT_EQ(accept(frames[3], edge), Status::kOk);
  EXPECT_EQ(accept(frames[3], edge + Duration{1}), Status::kStale);
}

TEST_F(NavigationReceiverTest, RefusesAMagneticHeading) {
  const NavigationFrames frames = frames_of(kNavigation);
  Frame magnetic;
  ASSERT_EQ(MessageWriter(kHeadingPgn).set("Heading", 1.0).set("Reference", 1).frame(kSource, magnetic), Status::kOk);
  EXPECT_EQ(accept(magnetic), Status::kUnsupported);
  EXPECT_EQ(accept(frames[1]), Status::kNotReady);
  EXPECT_EQ(accept(frames[2]), Status::kNotReady);
  EXPECT_EQ(accept(frames[3]), Status::kStale) << "no heading that we take has come";
}

TEST_F(NavigationReceiverTest, RefusesThePressureOfTheAir) {
  Frame air;
  ASSERT_EQ(MessageWriter(kPressurePgn).set("Source", 0).set("Pressure", 101'325.0).frame(kSource, air), Status::kOk);
  EXPECT_EQ(accept(air), Status::kUnsupported);
}

TEST_F(NavigationReceiverTest, RefusesFieldsThatAreNotAvailable) {
  Frame frame;
  ASSERT_EQ(MessageWriter(kSpeedPgn).frame(kSource, frame), Status::kOk);
  EXPECT_EQ(accept(frame), Status::kOutOfRange);
  ASSERT_EQ(MessageWriter(kPositionPgn).set("Latitude", 46.0).frame(kSource, frame), Status::kOk);
  EXPECT_EQ(accept(frame), Status::kOutOfRange);
  EXPECT_EQ(receiver_.counters().refused, 2U);
}

TEST_F(NavigationReceiverTest, RefusesFramesThatAreTooShort) {
  for (Frame frame : frames_of(kNavigation)) {
    frame.size = 1;
    EXPECT_NE(accept(frame), Status::kOk);
  }
  EXPECT_EQ(receiver_.counters().refused, 4U);
}

TEST_F(NavigationReceiverTest, PassesOverOtherMessages) {
  EXPECT_EQ(accept({.identifier = 0x09F113CC, .size = 8, .data = {}}), Status::kNotReady);
  EXPECT_EQ(receiver_.counters().other, 1U);
}

TEST(ComposeNavigation, RefusesWhatNoFrameCanCarry) {
  NavigationFrames frames;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  messages::Navigation bad = kNavigation;
  bad.speed = MetersPerSecond{-1.0};
  EXPECT_EQ(compose_navigation(bad, kPlane, kSource, frames), Status::kOutOfRange);
  bad = kNavigation;
  bad.heading = Radians{nan};
  EXPECT_EQ(compose_navigation(bad, kPlane, kSource, frames), Status::kOutOfRange);
  bad = kNavigation;
  bad.depth = Meters{nan};
  EXPECT_EQ(compose_navigation(bad, kPlane, kSource, frames), Status::kOutOfRange);
  bad = kNavigation;
  bad.position.north = Meters{1e7};
  EXPECT_EQ(compose_navigation(bad, kPlane, kSource, frames), Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::n2k
