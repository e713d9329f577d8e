#include "firmware/wire/n2k/vehicle_state/navigation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/setpoint.hpp"

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

TEST_F(NavigationReceiverTest, CountsWhatBecameOfEveryFrame) {
  const NavigationFrames frames = frames_of(kNavigation);
  const auto expect = [this](std::uint64_t accepted, std::uint64_t refused, std::uint64_t malformed, std::uint64_t waiting,
                             std::uint64_t other) {
    EXPECT_EQ(receiver_.counters().accepted, accepted);
    EXPECT_EQ(receiver_.counters().refused, refused);
    EXPECT_EQ(receiver_.counters().malformed, malformed);
    EXPECT_EQ(receiver_.counters().waiting, waiting);
    EXPECT_EQ(receiver_.counters().other, other);
  };
  expect(0, 0, 0, 0, 0);
  static_cast<void>(accept(frames[3]));
  expect(0, 0, 0, 1, 0);
  for (const Frame& frame : frames) static_cast<void>(accept(frame));
  expect(1, 0, 0, 1, 0);
  Frame magnetic;
  ASSERT_EQ(MessageWriter(kHeadingPgn).set("Heading", 1.0).set("Reference", 1).frame(kSource, magnetic), Status::kOk);
  static_cast<void>(accept(magnetic));
  expect(1, 1, 0, 1, 0);
  Frame cut = frames[3];
  cut.size = 7;
  static_cast<void>(accept(cut));
  expect(1, 2, 1, 1, 0);
  static_cast<void>(accept({.identifier = 0x09F200CC}));  // 127488, an engine
  expect(1, 2, 1, 1, 1);
}

TEST_F(NavigationReceiverTest, RefusesAPositionFarFromItsPlane) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames_of(kNavigation)[i]), Status::kNotReady);
  Frame far_away;
  ASSERT_EQ(MessageWriter(kPositionPgn).set("Latitude", 49.0).set("Longitude", -1.3).frame(kSource, far_away), Status::kOk);
  EXPECT_EQ(accept(far_away), Status::kOutOfRange);
  EXPECT_EQ(receiver_.counters().refused, 1U);
}

TEST_F(NavigationReceiverTest, TakesNothingOutOfSetpointsOfOurOwnComeBack) {
  SetpointFrames own;
  ASSERT_EQ(compose_setpoint({.heading = Radians{1}, .speed = MetersPerSecond{2}, .depth = Meters{50}, .waypoint = {}}, kSource, 0, own),
            Status::kOk);
  for (const Frame& frame : own) EXPECT_EQ(accept(frame), Status::kNotReady);
  EXPECT_EQ(receiver_.counters().other, own.size());
  EXPECT_FALSE(receiver_.sensors().readings().heading.has_value());
  EXPECT_FALSE(receiver_.sensors().readings().speed.has_value());
  EXPECT_FALSE(receiver_.sensors().readings().depth.has_value());
}

TEST_F(NavigationReceiverTest, WaitsUntilHeadingAndPressureHaveCome) {
  const NavigationFrames frames = frames_of(kNavigation);
  EXPECT_EQ(accept(frames[3]), Status::kStale);
  EXPECT_EQ(accept(frames[0]), Status::kNotReady);
  EXPECT_EQ(accept(frames[1]), Status::kNotReady);
  EXPECT_EQ(accept(frames[3]), Status::kStale);
  EXPECT_EQ(accept(frames[2]), Status::kNotReady);
  EXPECT_EQ(accept(frames[3]), Status::kOk);
  EXPECT_EQ(receiver_.counters().waiting, 2U);
}

TEST_F(NavigationReceiverTest, DoesNotMakeAFixOfPartsThatAreTooFarApart) {
  const NavigationFrames frames = frames_of(kNavigation);
  const Duration most = NavigationSettings{}.oldest_part;
  for (const std::size_t part : {0U, 2U}) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames[i]), Status::kNotReady);
    EXPECT_EQ(accept(frames[2 - part], kNow + Duration{1}), Status::kNotReady);
    EXPECT_EQ(accept(frames[3], kNow + most), Status::kOk);
    EXPECT_EQ(accept(frames[3], kNow + most + Duration{1}), Status::kStale);
  }
}

TEST_F(NavigationReceiverTest, TakesTheMissionsWordForHowOldAPartMayBe) {
  const NavigationFrames frames = frames_of(kNavigation);
  NavigationReceiver strict(kPlane, {.sensors = {}, .oldest_part = Duration::milliseconds(500)});
  Fix fix;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(strict.accept(frames[i], kNow, fix), Status::kNotReady);
  EXPECT_EQ(strict.accept(frames[3], kNow + Duration::milliseconds(501), fix), Status::kStale);
  EXPECT_EQ(strict.accept(frames[3], kNow + Duration::milliseconds(500), fix), Status::kOk);
}

TEST_F(NavigationReceiverTest, MakesAFixWithoutASpeed) {
  const NavigationFrames frames = frames_of(kNavigation);
  NavigationReceiver receiver(kPlane);
  Fix fix;
  for (const std::size_t i : {0U, 2U}) EXPECT_EQ(receiver.accept(frames[i], kNow, fix), Status::kNotReady);
  ASSERT_EQ(receiver.accept(frames[3], kNow, fix), Status::kOk);
  EXPECT_FALSE(fix.speed.has_value());
  ASSERT_EQ(receiver.accept(frames[1], kNow, fix), Status::kNotReady);
  ASSERT_EQ(receiver.accept(frames[3], kNow, fix), Status::kOk);
  EXPECT_DOUBLE_EQ(fix.speed->value, 2.0);
  // An old speed is none.
  for (const std::size_t i : {0U, 2U}) EXPECT_EQ(receiver.accept(frames[i], kNow + Duration::seconds(5), fix), Status::kNotReady);
  ASSERT_EQ(receiver.accept(frames[3], kNow + Duration::seconds(5), fix), Status::kOk);
  EXPECT_FALSE(fix.speed.has_value());
}

TEST_F(NavigationReceiverTest, GivesAFixWithoutASpeedBackAsOne) {
  messages::Navigation without = kNavigation;
  without.speed = messages::kUnknownSpeed;
  const NavigationFrames frames = frames_of(without);
  EXPECT_EQ(frames[1].data, (std::array<std::uint8_t, 8>{255, 255, 255, 255, 255, 255, 255, 255})) << "not available";
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames[i]), Status::kNotReady);
  ASSERT_EQ(accept(frames[3]), Status::kOk);
  EXPECT_TRUE(std::isnan(navigation_.speed.value));
  EXPECT_TRUE(messages::is_usable(navigation_));
}

TEST_F(NavigationReceiverTest, DatesAFixByThePositionsFirstFrame) {
  const NavigationFrames frames = frames_of(kNavigation);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames[i]), Status::kNotReady);
  auto gnss = MessageWriter(kGnssPgn);
  gnss.set("Latitude", 46.0).set("Longitude", -1.3).set("Method", 1);
  FastPacketFrames packet;
  ASSERT_EQ(compose_fast_packet(gnss.identifier(kSource), 0, gnss.bytes(), packet), Status::kOk);
  Status status = Status::kNotReady;
  for (std::size_t i = 0; i < packet.size(); ++i) {
    EXPECT_EQ(status, Status::kNotReady);
    status = accept(packet[i], kNow + Duration::milliseconds(100 + 10 * static_cast<std::int64_t>(i)));
  }
  ASSERT_EQ(status, Status::kOk);
  EXPECT_EQ(navigation_.time, kNow + Duration::milliseconds(100));
  EXPECT_EQ(navigation_.position.north.value, 0.0);
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

TEST_F(NavigationReceiverTest, PassesOverThePressureOfTheAir) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames_of(kNavigation)[i]), Status::kNotReady);
  Frame air;
  ASSERT_EQ(MessageWriter(kPressurePgn).set("Source", 0).set("Pressure", 101'325.0).frame(kSource, air), Status::kOk);
  EXPECT_EQ(accept(air), Status::kNotReady);
  EXPECT_EQ(receiver_.counters().refused, 0U);
  ASSERT_EQ(accept(frames_of(kNavigation)[3]), Status::kOk);
  EXPECT_NEAR(navigation_.depth.value, 300.0, 5e-6);
}

TEST_F(NavigationReceiverTest, MakesNothingOfWhatIsNotAvailable) {
  const NavigationFrames frames = frames_of(kNavigation);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(accept(frames[i]), Status::kNotReady);
  Frame frame;
  ASSERT_EQ(MessageWriter(kPositionPgn).set("Latitude", 46.0).frame(kSource, frame), Status::kOk);
  EXPECT_EQ(accept(frame), Status::kNotReady);
  ASSERT_EQ(MessageWriter(kPressurePgn).set("Instance", 0).set("Source", 1).frame(kSource, frame), Status::kOk);
  EXPECT_EQ(accept(frame), Status::kNotReady);
  EXPECT_EQ(accept(frames[3]), Status::kStale) << "a depth that its sensor takes back";
  EXPECT_EQ(receiver_.counters().refused, 0U);
  EXPECT_EQ(receiver_.sensors().counters().unavailable, 2U);
}

TEST_F(NavigationReceiverTest, RefusesFramesThatAreTooShort) {
  for (Frame frame : frames_of(kNavigation)) {
    frame.size = 1;
    EXPECT_NE(accept(frame), Status::kOk);
  }
  EXPECT_EQ(receiver_.counters().refused, 4U);
}

TEST_F(NavigationReceiverTest, PassesOverOtherMessages) {
  EXPECT_EQ(accept({.identifier = 0x09F200CC, .size = 8, .data = {}}), Status::kNotReady);  // 127488, an engine
  EXPECT_EQ(receiver_.counters().other, 1U);
}

TEST(ComposeNavigation, RefusesWhatNoFrameCanCarry) {
  NavigationFrames frames;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  messages::Navigation bad = kNavigation;
  for (const double speed : {-1.0, std::numeric_limits<double>::infinity()}) {
    bad.speed = MetersPerSecond{speed};
    EXPECT_EQ(compose_navigation(bad, kPlane, kSource, frames), Status::kOutOfRange);
  }
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
