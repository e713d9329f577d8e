#include "firmware/policy/check/policy_check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "firmware/core/math.hpp"
#include "tests/firmware/policy/made_up_policy.hpp"

namespace earshot::policy {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kWideNan = std::numeric_limits<double>::quiet_NaN();

PolicyFault fault_after(const std::function<void(FrozenPolicy&)>& damage, const FrozenPolicy& good = *small_policy()) {
  const auto policy = std::make_unique<FrozenPolicy>(good);
  damage(*policy);
  return check(*policy).fault;
}

PolicyFault fault_in_belief(const std::function<void(BeliefModel&)>& damage) {
  return fault_after([&damage](FrozenPolicy& policy) { damage(policy.observation.belief); }, *believing_policy());
}

TEST(PolicyCheck, FindsNothingWrongWithAGoodPolicy) {
  EXPECT_TRUE(check(*small_policy()).is_none());
  EXPECT_TRUE(check(*believing_policy()).is_none());
}

TEST(PolicyCheck, RefusesSizesThatDoNotFit) {
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.observation_size = 3; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.hidden_sizes[0] = 0; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.hidden_sizes[1] = 65; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions.clear(); }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[0].age = 1; }), PolicyFault::kBadShape);
}

TEST(PolicyCheck, RefusesNumbersOfTheSearchThatCannotBe) {
  for (const double length : {0.0, 0.5, -1.0, 1.1e6, kWideNan})
    EXPECT_EQ(fault_after([length](FrozenPolicy& policy) { policy.step_length = Meters{length}; }), PolicyFault::kOutOfRange) << length;
  for (const double length : {0.0, 0.5, 1.1e7, kWideNan})
    EXPECT_EQ(fault_after([length](FrozenPolicy& policy) { policy.area_size.east = Meters{length}; }), PolicyFault::kOutOfRange) << length;
  for (const double threshold : {-601.0, 601.0, kWideNan})
    EXPECT_EQ(fault_after([threshold](FrozenPolicy& policy) { policy.detection_threshold = Decibels{threshold}; }),
              PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0].north = 0.5; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0].north = kWideNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.draw = ActionDraw{3}; }), PolicyFault::kUnknownDraw);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[1].offset = kNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[1].feature = Feature{10}; }), PolicyFault::kUnknownFeature);
}

TEST(PolicyCheck, RefusesABeliefThatCannotBe) {
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.cells_north = 0; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.cells_north = 50; }), PolicyFault::kBadShape);  // 50 x 51 are more than 2500
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.snr_db.clear(); }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.step_length = Meters{999}; }), PolicyFault::kBadShape);  // of another search
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.snr_db[2] = kNan; }), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.snr_db[2] = 3e38F; }), PolicyFault::kOutOfRange);
  for (const float spread : {0.0F, 1e-39F, 0.04F, 101.0F, kNan})
    EXPECT_EQ(fault_in_belief([spread](BeliefModel& m) { m.hypotheses[0].spread_db = spread; }), PolicyFault::kOutOfRange) << spread;
  for (const float prior : {-1.0F, 1e-7F, 3e38F, kNan})
    EXPECT_EQ(fault_in_belief([prior](BeliefModel& m) { m.hypotheses[1].prior = prior; }), PolicyFault::kOutOfRange) << prior;
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.hypotheses[0].level_offset_db = -601.0F; }), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.outlier_share = 1.5F; }), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.silence_share = kNan; }), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.forgotten_share = 0.6F; }), PolicyFault::kOutOfRange);
  for (const double step : {0.0, 0.5, 10'001.0})
    EXPECT_EQ(fault_in_belief([step](BeliefModel& m) { m.range_step = Meters{step}; }), PolicyFault::kOutOfRange) << step;
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.border_width = Meters{1.1e6}; }), PolicyFault::kOutOfRange);
}

TEST(PolicyCheck, RefusesCostsOutOfTheirRange) {
  const auto refused = [](float BeliefCosts::*cost, float value) {
    return fault_in_belief([=](BeliefModel& m) { m.costs.*cost = value; }) == PolicyFault::kOutOfRange;
  };
  for (const auto cost : {&BeliefCosts::step, &BeliefCosts::edge, &BeliefCosts::most_regret, &BeliefCosts::reach}) {
    EXPECT_TRUE(refused(cost, -1.0F) && refused(cost, 1.1e6F) && refused(cost, kNan));
    EXPECT_FALSE(refused(cost, 1e6F));
  }
  EXPECT_TRUE(refused(&BeliefCosts::reach, 0.0F));
  EXPECT_TRUE(refused(&BeliefCosts::reach_discount, 1.1F));
  for (const float discount : {0.0F, -1e-4F, 0.1F, -11.0F, kNan}) EXPECT_TRUE(refused(&BeliefCosts::log_step_discount, discount));
}

TEST(PolicyCheck, RefusesGoldenPlacesAndSoundsThatCannotBe) {
  const auto place = [](double north) {
    return fault_after([north](FrozenPolicy& policy) { policy.golden[1][5].place.north = Meters{north}; });
  };
  EXPECT_EQ(place(-0.1), PolicyFault::kOutOfRange);
  EXPECT_EQ(place(25'000.1), PolicyFault::kOutOfRange);
  EXPECT_EQ(place(kWideNan), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.golden[0][0].reception.snr = Decibels{kWideNan}; }), PolicyFault::kOutOfRange);
}

TEST(PolicyCheck, RefusesWeightsThatAreNotFinite) {
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.second.bias[2] = kNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.first.weight(4, 1) = kNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.first.weight(5, 0) = kNan; }), PolicyFault::kNone) << "not a weight";
}

TEST(PolicyCheck, RefusesWhatCouldOverflowForSomeObservation) {
  // Of three units with tanh <= 1: |logit| <= 3 |w| + |b|, which may be 1e30. The golden searches alone would not find it.
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.output.weight(1, 1) = 0.9e30F; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.output.weight(1, 1) = -1.1e30F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.second.bias[0] = 1.1e30F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.first.weight(0, 0) = 1.1e30F; }), PolicyFault::kUnbounded);
  // A place in an area of 25 km x 26 km is within 103 km whatever it is measured from: scaled by more than 1e4 it could pass 1e9.
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[0].scale = 1e5F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[0].offset = -3e38F; }), PolicyFault::kUnbounded);
}

TEST(PolicyCheck, LetsPassNoWeightsWhoseLogitsOverflowAnywhereInTheArea) {
  // The largest weights that may fly, all of one sign, in the corner where every element is largest.
  auto policy = small_policy();
  for (ObservationElement& element : policy->observation.spec) element = {.feature = element.feature, .offset = 0.0F, .scale = 9e3F};
  policy->network.first.packed.fill(5e20F);
  policy->network.second.packed.fill(1.9e29F);
  policy->network.output.packed.fill(3.2e29F);
  ASSERT_TRUE(check(*policy).is_none());
  for (GoldenStep& step : policy->golden[0]) step.place = policy->area_size;
  record(*policy);
  EXPECT_TRUE(repeats(*policy));
  for (const float logit : policy->golden[0][5].logits) EXPECT_TRUE(is_finite(logit));
}

}  // namespace
}  // namespace earshot::policy
