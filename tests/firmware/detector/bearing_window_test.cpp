#include "firmware/detector/bearing_window.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace earshot::detector {
namespace {

using messages::Bearing;
using messages::BearingMeasurement;
using Verdict = BearingWindow::Verdict;

constexpr Duration kFarthest = Duration::seconds(5);

constexpr Time at_s(double s) {
  return Time{1'000'000'000} + Duration{static_cast<std::int64_t>(s * 1e6)};
}

constexpr Bearing bearing(double direction) {
  return {.direction = Radians{direction}, .deviation = Radians{0.2}};
}

class BearingWindowTest : public testing::Test {
 protected:
  /// What is measured and arrives at one time.
  Verdict hear(double s, double direction, std::uint32_t sender = 1, std::uint8_t port = 0) {
    return hear_late(s, s, direction, sender, port);
  }
  Verdict hear_late(double arrival_s, double measured_s, double direction, std::uint32_t sender = 1, std::uint8_t port = 0) {
    return window_.take(at_s(arrival_s), port, {.time = at_s(measured_s), .bearing = bearing(direction), .sender = sender}, kFarthest);
  }

  BearingWindow window_;
};

TEST_F(BearingWindowTest, RemembersTheNewest) {
  EXPECT_FALSE(window_.heard_after(Time{}));
  EXPECT_EQ(hear(1, 0.5), Verdict::kTaken);
  EXPECT_EQ(hear(2, 1.5), Verdict::kTaken);
  EXPECT_EQ(window_.heard_after(Time{}), bearing(1.5));
}

TEST_F(BearingWindowTest, KeepsTheMirrorsAxis) {
  const Bearing ambiguous{.direction = Radians{1.0}, .deviation = Radians{0.2}, .mirror_axis = Radians{0.25}};
  EXPECT_EQ(window_.take(at_s(1), 0, {.time = at_s(1), .bearing = ambiguous}, kFarthest), Verdict::kTaken);
  EXPECT_EQ(window_.heard_after(Time{}), ambiguous);
}

TEST_F(BearingWindowTest, RefusesWhatIsNoAngleWhoeverSendsIt) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  ASSERT_EQ(hear(1, 0.5), Verdict::kTaken);
  for (const double bad : {kNan, std::numeric_limits<double>::infinity(), -0.1, 6.3}) {
    EXPECT_EQ(hear(2, bad), Verdict::kRefused) << bad;
    EXPECT_EQ(hear(2, bad, 2), Verdict::kRefused) << bad;
  }
  for (const double bad : {kNan, 0.0, -0.2, 3.15}) {
    const BearingMeasurement measurement{.time = at_s(2), .bearing = {.direction = Radians{1.0}, .deviation = Radians{bad}}, .sender = 1};
    EXPECT_EQ(window_.take(at_s(2), 0, measurement, kFarthest), Verdict::kRefused) << bad;
  }
  EXPECT_EQ(window_.heard_after(Time{}), bearing(0.5));
}

TEST_F(BearingWindowTest, RefusesWhatIsDatedFurtherFromItsArrivalThanItMayBe) {
  EXPECT_EQ(hear_late(10, 5, 0.5), Verdict::kTaken) << "just as old as it may be";
  EXPECT_EQ(hear_late(10.5, 5.499999, 0.6), Verdict::kRefused);
  EXPECT_EQ(hear_late(10.5, 15.500001, 0.6), Verdict::kRefused) << "of a clock that is too fast";
  EXPECT_EQ(window_.take(at_s(11), 0, {.time = Time{-1}, .bearing = bearing(0.6), .sender = 1}, kFarthest), Verdict::kRefused);
  EXPECT_EQ(window_.heard_after(Time{}), bearing(0.5));
}

TEST_F(BearingWindowTest, RefusesWhatIsOlderThanTheNewestButTakesItAgain) {
  ASSERT_EQ(hear(10, 0.5), Verdict::kTaken);
  EXPECT_EQ(hear_late(11, 9.999999, 0.6), Verdict::kRefused);
  EXPECT_EQ(hear_late(11, 10, 0.7), Verdict::kTaken);
  EXPECT_EQ(window_.heard_after(Time{}), bearing(0.7));
}

TEST_F(BearingWindowTest, DatesWhatComesFromAheadByItsArrivalSoThatWhatFollowsIsNotHidden) {
  ASSERT_EQ(hear_late(10, 14, 0.5), Verdict::kTaken);
  EXPECT_FALSE(window_.heard_after(at_s(10))) << "it counts as of its arrival";
  EXPECT_EQ(hear(11, 0.6), Verdict::kTaken);
}

TEST_F(BearingWindowTest, ListensToTheFirstSenderUntilThatIsSilentForTwoMinutes) {
  ASSERT_EQ(hear(0, 0.5, 1), Verdict::kTaken);
  EXPECT_EQ(hear(1, 2.5, 2), Verdict::kOfAnother);
  ASSERT_EQ(hear(2, 0.6, 1), Verdict::kTaken);
  EXPECT_EQ(hear(121, 2.5, 2), Verdict::kOfAnother) << "119 s after its last";
  EXPECT_EQ(hear(122, 2.5, 2), Verdict::kOfAnother) << "120 s";
  EXPECT_EQ(window_.heard_after(Time{}), bearing(0.6));
  EXPECT_EQ(hear(122.000001, 2.6, 2), Verdict::kTaken);
  EXPECT_EQ(hear(123, 0.7, 1), Verdict::kOfAnother) << "now it is the other way round";
  EXPECT_EQ(window_.heard_after(Time{}), bearing(2.6));
}

TEST_F(BearingWindowTest, DoesNotLetASenderHoldByWhatIsRefused) {
  ASSERT_EQ(hear(0, 0.5, 1), Verdict::kTaken);
  ASSERT_EQ(hear(100, -1.0, 1), Verdict::kRefused);
  EXPECT_EQ(hear(121, 2.5, 2), Verdict::kTaken);
}

TEST_F(BearingWindowTest, KnowsASenderByItsPortToo) {
  ASSERT_EQ(hear(0, 0.5, 1, 3), Verdict::kTaken);
  EXPECT_EQ(hear(1, 0.6, 1, 4), Verdict::kOfAnother);
  EXPECT_EQ(hear(1, 0.6, 1, 3), Verdict::kTaken);
}

TEST_F(BearingWindowTest, GivesNoneThatIsOlderThanAskedFor) {
  ASSERT_EQ(hear(10, 0.5), Verdict::kTaken);
  EXPECT_EQ(window_.heard_after(at_s(9.999999)), bearing(0.5));
  EXPECT_FALSE(window_.heard_after(at_s(10)));
}

TEST_F(BearingWindowTest, GivesNoneTwiceToTwoDecisions) {
  ASSERT_EQ(hear(10, 0.5), Verdict::kTaken);
  window_.begin_leg(at_s(10));
  EXPECT_FALSE(window_.heard_after(Time{}));
  ASSERT_EQ(hear_late(11, 10, 0.6), Verdict::kTaken) << "in its order, and yet of the last leg";
  EXPECT_FALSE(window_.heard_after(Time{}));
  ASSERT_EQ(hear(11, 0.7), Verdict::kTaken);
  EXPECT_EQ(window_.heard_after(Time{}), bearing(0.7));
}

}  // namespace
}  // namespace earshot::detector
