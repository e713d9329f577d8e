#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_belief_rig.hpp"

namespace earshot::policy {
namespace {

/// What the way costs once all is as expected, and what it costs in these tests before.
constexpr BeliefCosts kCheap{.step = 0.15F, .log_step_discount = -0.010050336F, .reach = 10.0F, .most_regret = 1'000.0F};  // ln 0.99
constexpr BeliefCosts kDear{.step = 10.0F, .log_step_discount = -0.16F, .reach = 100.0F, .most_regret = 1'000.0F};
constexpr auto kFourPerKilometre = [](double km) { return 32.0 - 4.0 * km; };

class AsExpectedTest : public OceanBeliefRig {
 protected:
  /// What is heard at twelve places of a source at (7 km, 8 km), so much louder than kTwoPerKilometre says, without any fluctuation.
  static Looks exact(double louder_db = 0.0) {
    Looks looks;
    for (int i = 0; i < 12; ++i) {
      const NorthEast place = at(700.0 * i, 2'000.0 + 1'500.0 * (i % 3));
      looks.push_back({place, {.snr = Decibels{kTwoPerKilometre(range_between(place, kSource).value / 1'000.0) + louder_db}}});
    }
    return looks;
  }

  /// Probability by the belief of one of these oceans, at its level, with the least spread, without pauses and at rest.
  float share_at_rest(std::initializer_list<std::uint8_t> oceans) const {
    float sum = 0.0F;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
      for (const std::uint8_t ocean : oceans)
        sum += belief->hypothesis(i) == Hypothesis{.table = ocean, .level = 3, .spread = 0} ? belief->share(i) : 0.0F;
    }
    return sum;
  }

  /// Whether both say the same of every action.
  static bool agree(const OceanBelief& a, const OceanBelief& b) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (a.outlook(k).regret != b.outlook(k).regret) return false;
    }
    return true;
  }

  /// Number of looks after which a policy of these costs says the same as one of others, which it must where these oceans' share is 35 %.
  int looks_as_if(const BeliefCosts& costs, const BeliefCosts& as_if, const Looks& looks, std::initializer_list<std::uint8_t> oceans) {
    const auto other = std::make_unique<OceanBelief>();
    BeliefModel others = model;
    model.costs = costs;
    others.costs = as_if;
    belief->start(model, tables);
    other->start(others, tables);
    int same = 0;
    for (const auto& [place, heard] : looks) {
      belief->update(model, tables, place, heard);
      other->update(others, tables, place, heard);
      EXPECT_EQ(agree(*belief, *other), share_at_rest(oceans) >= 0.35F) << "share " << share_at_rest(oceans);
      same += agree(*belief, *other) ? 1 : 0;
    }
    return same;
  }

  /// Were others put in the place of all of them or of some, a policy of those would say the same.
  void expect_own_costs(const BeliefCosts& costs, const Looks& looks) {
    BeliefCosts way_replaced = costs;
    way_replaced.step = kCheap.step;
    way_replaced.log_step_discount = kCheap.log_step_discount;
    BeliefCosts reach_replaced = costs;
    reach_replaced.reach = kCheap.reach;
    for (const BeliefCosts& replaced : {kCheap, way_replaced, reach_replaced}) {
      const auto other = std::make_unique<OceanBelief>();
      BeliefModel others = model;
      model.costs = costs;
      others.costs = replaced;
      belief->start(model, tables);
      other->start(others, tables);
      for (const auto& [place, heard] : looks) {
        belief->update(model, tables, place, heard);
        other->update(others, tables, place, heard);
      }
      EXPECT_GE(share_at_rest({0}), 0.35F);
      EXPECT_FALSE(agree(*belief, *other)) << costs.step;
    }
  }

  static inline const NorthEast kSource = at(7'000, 8'000);
};

/// From 35 % on for the ocean that was the likeliest beforehand, at its level, with the least spread, without pauses and at rest.
TEST_F(AsExpectedTest, TheWayCountsForLess) {
  add_table(tables, 1.0F, kFourPerKilometre);
  add_table(tables, 3.0F, kTwoPerKilometre);
  const int looks = looks_as_if(kDear, kCheap, exact(), {1});
  EXPECT_GT(looks, 0);
  EXPECT_LT(looks, 12);
  EXPECT_EQ(looks_as_if(kDear, kCheap, exact(6.0), {1}), 0);
}

TEST_F(AsExpectedTest, IsAnyOfSeveralOceansAsLikely) {
  add_table(tables, 3.0F, kFourPerKilometre);
  add_table(tables, 3.0F, kTwoPerKilometre);
  add_table(tables, 1.0F, [](double km) { return 20.0 - km; });
  EXPECT_GT(looks_as_if(kDear, kCheap, exact(), {0, 1}), 0);
}

/// What is heard is that of an ocean less likely beforehand.
TEST_F(AsExpectedTest, IsNoOtherOcean) {
  add_table(tables, 3.0F, kFourPerKilometre);
  add_table(tables, 1.0F, kTwoPerKilometre);
  EXPECT_EQ(looks_as_if(kDear, kCheap, exact(), {0}), 0);
  EXPECT_GE(share_at_rest({1}), 0.35F);
}

/// Without an end it costs 10.05, 14.07, 1.99 and 3.00; the one that would replace it 15.
TEST_F(AsExpectedTest, AWayThatIsCheapAlreadyCostsWhatItDid) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  for (const auto& [step, log_discount] : {std::pair{0.1F, -0.01F}, {0.14F, -0.01F}, {1.0F, -0.7F}, {3.0F, -10.0F}}) {
    BeliefCosts costs = kDear;
    costs.step = step;
    costs.log_step_discount = log_discount;
    expect_own_costs(costs, exact());
  }
  BeliefCosts hardly_dearer = kCheap;
  hardly_dearer.step = 0.16F;
  EXPECT_GT(looks_as_if(hardly_dearer, kCheap, exact(), {0}), 0);
}

/// What the others' costs are stays as it is, for no way is cheaper.
TEST_F(AsExpectedTest, AReachThatIsWorthLessCountsForNoMore) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  BeliefCosts worth_little = kDear;
  worth_little.reach = 2.0F;
  BeliefCosts cheap = kCheap;
  cheap.reach = 2.0F;
  EXPECT_GT(looks_as_if(worth_little, cheap, exact(), {0}), 0);
}

TEST_F(AsExpectedTest, WhereThereAreBearingsTheWayCostsWhatItDid) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  Looks looks = exact();
  for (auto& [place, heard] : looks)
    heard.bearing = messages::Bearing{.direction = Radians{std::atan2((kSource - place).east.value, (kSource - place).north.value)},
                                      .deviation = Radians{0.5}};
  expect_own_costs(kDear, looks);
}

/// A source may lie too deep in it for a cheap reach to be worth fetching.
TEST_F(AsExpectedTest, WhereTheBorderIsWiderThanAStepTheWayCostsWhatItDid) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  model.border_width = Meters{1'001.0};
  expect_own_costs(kDear, exact());
}

TEST_F(AsExpectedTest, HasTheSameBitsOnEveryMachine) {
  add_table(tables, 1.0F, kFourPerKilometre);
  add_table(tables, 3.0F, kTwoPerKilometre);
  model.costs = kDear;
  belief->start(model, tables);
  for (const auto& [place, heard] : exact()) hear(place, 0.125 * static_cast<double>(std::lround(8.0 * heard.snr.value)));
  EXPECT_GE(share_at_rest({1}), 0.35F);
  EXPECT_EQ(belief->fingerprint(model), 0x6F0C4ECCU);  // of x86-64, for SSE2 and for AVX2, and of aarch64
}

}  // namespace
}  // namespace earshot::policy
