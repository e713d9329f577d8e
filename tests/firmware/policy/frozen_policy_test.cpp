#include "firmware/policy/frozen_policy.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>

#include "tests/firmware/policy/made_up_policy.hpp"

namespace earshot::policy {
namespace {

/// A mission that small_policy() was trained for, its corners where a sum of doubles rounds.
config::Mission fitting_mission() {
  config::Mission mission;
  mission.operating_area.south_west = {.north = Meters{-5000.1}, .east = Meters{1000.3}};
  mission.operating_area.north_east = {.north = Meters{19999.9}, .east = Meters{27000.3}};
  mission.step_length = Meters{1000};
  mission.detection_threshold = Decibels{-3.5};
  return mission;
}

Mismatch mismatch_after(const std::function<void(config::Mission&)>& change) {
  config::Mission mission = fitting_mission();
  change(mission);
  return mismatch(*small_policy(), mission);
}

TEST(FrozenPolicy, FitsAMissionWhereverItsAreaLies) {
  EXPECT_EQ(mismatch(*small_policy(), fitting_mission()), Mismatch::kNone);
}

TEST(FrozenPolicy, DoesNotFitAMissionOfAnotherStepAreaOrThreshold) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.step_length = Meters{999}; }), Mismatch::kStepLength);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.operating_area.north_east.north += Meters{0.1}; }), Mismatch::kAreaSize);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.operating_area.north_east.east -= Meters{0.1}; }), Mismatch::kAreaSize);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.operating_area.south_west.east = Meters{kNan}; }), Mismatch::kAreaSize);
  EXPECT_EQ(mismatch_after([](auto& mission) { mission.detection_threshold = Decibels{-3.4}; }), Mismatch::kDetectionThreshold);
  EXPECT_EQ(mismatch_after([](auto& mission) {
              mission.listening = {config::Listening::kMean, Duration::seconds(15)};
            }),
            Mismatch::kListening);
}

TEST(FindLogits, AreThoseOfTheNetworkWhereThereIsOne) {
  const auto policy = small_policy();
  constexpr std::array kObservation{0.25F, -0.5F};
  std::array<float, 4> logits{};
  std::array<float, 4> expected{};
  find_logits(*policy, kObservation, logits);
  forward(policy->network, kObservation, expected);
  EXPECT_EQ(logits, expected);
  EXPECT_NE(logits[0], logits[1]);
}

TEST(FindLogits, AreThePreferencesInTheOrderOfTheActionsWhereThereIsNone) {
  constexpr std::array kObservation{9.0F, 0.3F, 0.2F, 1.0F, 0.5F};  // spread, then actions 3, 2, 1, 0
  std::array<float, 4> logits{};
  find_logits(*advising_policy(), kObservation, logits);
  EXPECT_EQ(logits, (std::array{0.5F, 1.0F, 0.2F, 0.3F}));
}

TEST(Network, IsThereWhenItHasAnyHiddenLayer) {
  EXPECT_TRUE(has_network(small_policy()->network));
  EXPECT_FALSE(has_network(advising_policy()->network));
  EXPECT_FALSE(has_network(FrozenPolicy{}.network));
  Network broken;
  broken.hidden_sizes = {0, 3};
  EXPECT_TRUE(has_network(broken)) << "one layer too few is a fault, not a policy without a network";
}

/// A 3-4-5 triangle, the vehicle at 300 m.
TEST(SearchedSound, IsHeardAcrossTheAreaAtTheSearchsDepth) {
  config::Mission mission = fitting_mission();
  mission.operating_area.north_east = mission.operating_area.south_west + NorthEast{.north = Meters{3'000}, .east = Meters{4'000}};
  mission.search_depth = Meters{300};
  mission.source_frequency = Hertz{35};
  const SearchedSound sound = searched_sound(mission);
  EXPECT_EQ(sound.vehicle_depth, Meters{300});
  EXPECT_EQ(sound.frequency, Hertz{35});
  EXPECT_NEAR(sound.furthest.value, 5'000.0, 1e-9);  // corners round
}

}  // namespace
}  // namespace earshot::policy
