#include "firmware/runtime/legs.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/place.hpp"

namespace earshot::runtime {
namespace {

constexpr Time kLegBegan{1'000'000'000};

TEST(Legs, HaveNotBegunBeforeTheFirstDecision) {
  Legs legs;
  EXPECT_FALSE(legs.has_begun());
  legs.begin(guidance::Leg(at(0, 0), at(300, 400)), kLegBegan);
  EXPECT_TRUE(legs.has_begun());
  EXPECT_EQ(legs.present().waypoint(), at(300, 400));
}

/// 500 m at 2 m/s from the decision on: 250 s.
TEST(Legs, WouldBeOverAfterTheirLengthAtTheSearchSpeedAndNotAMomentBefore) {
  Legs legs;
  legs.begin(guidance::Leg(at(0, 0), at(300, 400)), kLegBegan);
  EXPECT_FALSE(legs.would_be_over(kLegBegan + Duration{249'999'999}, MetersPerSecond{2}));
  EXPECT_TRUE(legs.would_be_over(kLegBegan + Duration{250'000'000}, MetersPerSecond{2}));
}

TEST(Legs, CountDecisionsAndStepsApart) {
  Legs legs;
  legs.begin(guidance::Leg(at(0, 0), at(300, 400)), kLegBegan);
  EXPECT_EQ(legs.decisions(), 1U);
  EXPECT_EQ(legs.steps_taken(), 0U) << "the first is still to be sailed";
  legs.count_step();
  EXPECT_EQ(legs.decisions(), 1U);
  EXPECT_EQ(legs.steps_taken(), 1U);
}

TEST(Legs, StayInterruptedUntilTheSearchDecidesAnew) {
  Legs legs;
  EXPECT_FALSE(legs.is_interrupted());
  legs.interrupt();
  EXPECT_TRUE(legs.is_interrupted());
  legs.decide_anew();
  EXPECT_FALSE(legs.is_interrupted());
}

}  // namespace
}  // namespace earshot::runtime
