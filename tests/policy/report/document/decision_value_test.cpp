#include "policy/report/document/decision_value.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "policy/explain/decision_follower.hpp"
#include "policy/report/explanation.hpp"
#include "tests/policy/explain/flown_policy.hpp"

namespace earshot::report {
namespace {

explain::RecordedDecision decision() {
  explain::RecordedDecision d;
  d.step = 3;
  d.position = {Meters{1'000.04}, Meters{-20.0}};
  d.snr = Decibels{9.456};
  d.detected = true;
  d.waypoint = {Meters{2'000.0}, Meters{-20.0}};
  d.action_count = 8;
  d.action = 1;
  return d;
}

TEST(DecisionValue, OfOneThatNothingExplainsHasWhatTheVehicleWroteDown) {
  explain::RecordedDecision d = decision();
  d.bearing = messages::Bearing{.direction = Radians{0.8203047484373349}, .deviation = Radians{0.17453292519943295}};  // 47 and 10 degrees
  d.bearing->mirror_axis = Radians{0.3490658503988659};                                                                // 20 degrees
  d.found.emplace().likeliest = {Meters{1'250.0}, Meters{250.0}};
  EXPECT_EQ(decision_value(12.3456, d, std::nullopt).dump(),
            R"({"step":3,"time_s":12.346,"at":{"north_m":1000,"east_m":-20},"snr_db":9.46,"too_faint":false,"detected":true,)"
            R"("bearing":{"toward_deg":47,"deviation_deg":10,"mirror_deg":353},"waypoint":{"north_m":2000,"east_m":-20},)"
            R"("direction":"NE","sweeping":false,"overridden":false,"declared":{"north_m":1250,"east_m":250},"reasons":[],"actions":[],)"
            R"("taken":1,"second_best":null,"hypotheses":[],"observed":[],"belief":null})");
}

TEST(DecisionValue, HasNoMirrorImageWhereLeftAndRightAreToldApart) {
  explain::RecordedDecision d = decision();
  d.bearing = messages::Bearing{.direction = Radians{0.0}, .deviation = Radians{0.17453292519943295}};
  EXPECT_EQ(decision_value(0.0, d, std::nullopt).at("bearing").dump(), R"({"toward_deg":0,"deviation_deg":10,"mirror_deg":null})");
}

/// Explains the last of the decisions of a policy whose area begins 1 km north of the plane's origin.
explain::DecisionAccount account_of_flown(const policy::FrozenPolicy& policy, std::size_t decisions) {
  const NorthEast south_west{Meters{1'000.0}, Meters{0.0}};
  explain::DecisionFollower follower({.policy = policy,
                                      .belief = policy.observation.belief,
                                      .tables = explain::falling_ocean(),
                                      .belief_is_the_policys = true,
                                      .south_west = south_west});
  const std::vector<explain::RecordedDecision> taken = explain::flown(policy, decisions, south_west);
  for (const explain::RecordedDecision& one : taken) follower.follow(one);
  return follower.account_of(taken.back());
}

TEST(DecisionValue, HasTheReasonsAndTheSecondBestOfAnAccount) {
  const auto policy = explain::belief_policy(1);
  const explain::DecisionAccount account = account_of_flown(*policy, 3);
  const nlohmann::ordered_json value = decision_value(0.0, account.decision, account);
  EXPECT_EQ(value.at("reasons"), sentences(account));
  ASSERT_EQ(value.at("actions").size(), 8U);
  EXPECT_EQ(value.at("actions").at(1).at("name"), "NE");
  double sum = 0.0;
  for (const auto& action : value.at("actions")) sum += action.at("probability").get<double>();
  EXPECT_NEAR(sum, 1.0, 8 * 0.00005) << "to a hundredth of a percent each";
  std::size_t best = 0;  // of those that were not taken
  double most = -1.0;
  for (std::size_t i = 0; i < 8; ++i) {
    if (i != account.decision.action && account.actions[i].probability > most) most = account.actions[best = i].probability;
  }
  EXPECT_EQ(value.at("second_best"), best);
  EXPECT_TRUE(value.at("observed").at(0).at("part").is_number());
}

TEST(DecisionValue, OfASweepHasNoSecondBestAndNothingThatMovedThePolicy) {
  const auto policy = explain::belief_policy(1);
  explain::DecisionAccount account = account_of_flown(*policy, 2);
  account.decision.sweeping = true;
  const nlohmann::ordered_json value = decision_value(0.0, account.decision, account);
  EXPECT_TRUE(value.at("second_best").is_null());
  EXPECT_TRUE(value.at("observed").at(0).at("part").is_null());
}

TEST(DecisionValue, OfAPolicyWithoutANetworkRanksByRegret) {
  const auto policy = explain::advice_policy();
  const explain::DecisionAccount account = account_of_flown(*policy, 2);
  const nlohmann::ordered_json value = decision_value(0.0, account.decision, account);
  EXPECT_EQ(value.at("actions").at(value.at("taken").get<std::size_t>()).at("regret_steps"), 0) << "it takes the best";
  EXPECT_TRUE(value.at("observed").at(0).at("part").is_null());
}

TEST(DecisionValue, PutsItsBeliefIntoTheMissionsPlane) {
  const auto policy = explain::belief_policy(1);
  const explain::DecisionAccount account = account_of_flown(*policy, 1);
  const nlohmann::ordered_json belief = decision_value(0.0, account.decision, account).at("belief");
  EXPECT_EQ(belief.at("south_west").dump(), R"({"north_m":1000,"east_m":0})");
  EXPECT_EQ(belief.at("size").dump(), R"({"north_m":25000,"east_m":25000})");
  EXPECT_EQ(belief.at("likeliest").at("north_m").get<double>(), 1'000.0 + account.place.likeliest.north.value);
  EXPECT_EQ(belief.at("area_of_cell").get<std::string>().size(), 4U * ((50 * 50 + 2) / 3)) << "a byte for each cell, in base64";
}

// 255 x (0, 0.5, 0.5, 1): the two that are as likely as each other lie behind the same half.
TEST(AreaOfCells, IsTheProbabilityOfAllThatIsLikelier) {
  EXPECT_EQ(area_of_cells({0.25, 0.5, 0.25, 0.0}), (std::vector<std::uint8_t>{128, 0, 128, 255}));
  EXPECT_EQ(area_of_cells({0.25, 0.25, 0.25, 0.25}), (std::vector<std::uint8_t>{0, 0, 0, 0}));
}

}  // namespace
}  // namespace earshot::report
