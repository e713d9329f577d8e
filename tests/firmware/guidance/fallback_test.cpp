#include "firmware/guidance/fallback.hpp"

#include <gtest/gtest.h>

#include <array>

namespace earshot::guidance {
namespace {

constexpr std::array<UnitNorthEast, 4> kFour{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr SweepPlan kPlan{.area = {{}, {Meters{10'000}, Meters{10'000}}}, .margin = Meters{0}, .step_length = Meters{1000}};
constexpr NorthEast kMiddle{Meters{5000}, Meters{5000}};

TEST(Fallback, DoesWhatIsWantedUntilSomethingSurprises) {
  Fallback fallback;
  EXPECT_EQ(fallback.choose(false, 3, kPlan, kMiddle, kFour), 3U);
  EXPECT_FALSE(fallback.is_sweeping());
}

TEST(Fallback, SweepsAsLongAsASweepIsCalledFor) {
  Fallback fallback;
  Sweep sweep(kPlan, kMiddle);
  const NorthEast further{Meters{4000}, Meters{5000}};
  EXPECT_EQ(fallback.choose(true, 9, kPlan, kMiddle, kFour), sweep.next(kMiddle, kFour).action);
  EXPECT_TRUE(fallback.is_sweeping());
  EXPECT_EQ(fallback.choose(true, 9, kPlan, further, kFour), sweep.next(further, kFour).action);
  EXPECT_EQ(fallback.choose(false, 9, kPlan, further, kFour), 9U);
  EXPECT_FALSE(fallback.is_sweeping());
}

TEST(Fallback, PlansItsNextSweepFromWhereTheVehicleIsThen) {
  const NorthEast corner{Meters{9500}, Meters{9500}};
  Fallback fallback;
  (void)fallback.choose(true, 0, kPlan, kMiddle, kFour);
  (void)fallback.choose(false, 0, kPlan, kMiddle, kFour);
  Sweep sweep(kPlan, corner);
  for (const NorthEast place : {corner, NorthEast{Meters{8500}, Meters{9500}}})
    EXPECT_EQ(fallback.choose(true, 0, kPlan, place, kFour), sweep.next(place, kFour).action);
}

TEST(Fallback, HasForgottenItsSweepWhenANewSearchBegins) {
  Fallback fallback;
  (void)fallback.choose(true, 0, kPlan, kMiddle, kFour);
  fallback.start();
  EXPECT_EQ(fallback.choose(false, 2, kPlan, kMiddle, kFour), 2U);
}

}  // namespace
}  // namespace earshot::guidance
