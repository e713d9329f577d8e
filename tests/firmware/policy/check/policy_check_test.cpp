#include "firmware/policy/check/policy_check.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "firmware/core/math.hpp"
#include "tests/firmware/not_finite.hpp"
#include "tests/firmware/policy/made_up_policy.hpp"

namespace earshot::policy {
namespace {

using tests::kNan;

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
  EXPECT_TRUE(check(*advising_policy()).is_none());
}

TEST(PolicyCheck, RefusesAnActivationThatNobodyKnows) {
  for (const int activation : {0, 3, 255})
    EXPECT_EQ(fault_after([activation](FrozenPolicy& policy) { policy.network.activation = static_cast<Activation>(activation); }),
              PolicyFault::kUnknownActivation)
        << activation;
}

TEST(PolicyCheck, RefusesANetworkThatIsTooLargeWithItsSize) {
  const auto policy = small_policy();
  policy->network.hidden_sizes = {Network::kWidth + 1, 3};
  const PolicyComplaint complaint = check(*policy);
  EXPECT_EQ(complaint.fault, PolicyFault::kTooLarge);
  EXPECT_EQ(complaint.section, kNetworkSection);
  // Two inputs, four actions: blocks of 64 outputs, one more than holds the widest layer.
  constexpr std::size_t kFirst = Network::kWidth + 64;
  EXPECT_EQ(complaint.size, 4 * (kFirst * 3 + 64 * (Network::kWidth + 2) + 8 * 4));
}

TEST(PolicyCheck, RefusesSizesThatDoNotFit) {
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.observation_size = 3; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.hidden_sizes[0] = 0; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.hidden_sizes[1] = 0; }), PolicyFault::kNone) << "one layer";
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.hidden_sizes = {5, 0, 3}; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.hidden_sizes[0] = std::size_t{1} << 31U; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions.clear(); }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[0].age = 1; }), PolicyFault::kBadShape);
}

TEST(PolicyCheck, RefusesNumbersOfTheSearchThatCannotBe) {
  for (const double length : {0.0, 0.5, -1.0, 1.1e6, kNan})
    EXPECT_EQ(fault_after([length](FrozenPolicy& policy) { policy.step_length = Meters{length}; }), PolicyFault::kOutOfRange) << length;
  for (const double length : {0.0, 0.5, 1.1e7, kNan})
    EXPECT_EQ(fault_after([length](FrozenPolicy& policy) { policy.area_size.east = Meters{length}; }), PolicyFault::kOutOfRange) << length;
  for (const double threshold : {-601.0, 601.0, kNan})
    EXPECT_EQ(fault_after([threshold](FrozenPolicy& policy) { policy.detection_threshold = Decibels{threshold}; }),
              PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0].north = 0.5; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0].north = kNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.draw = ActionDraw{3}; }), PolicyFault::kUnknownDraw);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[1].offset = kNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[1].feature = Feature{10}; }), PolicyFault::kUnknownFeature);
}

TEST(PolicyCheck, RefusesABeliefThatCannotBe) {
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.cells_north = 0; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.cells_north = 50; }), PolicyFault::kBadShape);           // 50 x 51 are more than 2500
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.step_length = Meters{999}; }), PolicyFault::kBadShape);  // of another search
  for (const float share : {-0.1F, 1.5F, static_cast<float>(kNan)})
    EXPECT_EQ(fault_in_belief([share](BeliefModel& m) { m.outlier_share = share; }), PolicyFault::kOutOfRange) << share;
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.border_width = Meters{1.1e6}; }), PolicyFault::kOutOfRange);
}

TEST(PolicyCheck, RefusesCostsOutOfTheirRange) {
  const auto refused = [](float BeliefCosts::*cost, float value) {
    return fault_in_belief([=](BeliefModel& m) { m.costs.*cost = value; }) == PolicyFault::kOutOfRange;
  };
  for (const auto cost : {&BeliefCosts::step, &BeliefCosts::edge, &BeliefCosts::most_regret, &BeliefCosts::find_probability}) {
    EXPECT_TRUE(refused(cost, -1.0F) && refused(cost, 1.1e6F) && refused(cost, kNan));
    EXPECT_FALSE(refused(cost, 1e6F));
  }
  EXPECT_TRUE(refused(&BeliefCosts::find_probability, 0.0F));
  EXPECT_TRUE(refused(&BeliefCosts::find_discount, 1.1F));
  for (const float discount : {0.0F, -1e-4F, 0.1F, -11.0F, static_cast<float>(kNan)})
    EXPECT_TRUE(refused(&BeliefCosts::log_step_discount, discount));
}

TEST(PolicyCheck, RefusesGoldenPlacesAndSoundsThatCannotBe) {
  const auto place = [](double north) {
    return fault_after([north](FrozenPolicy& policy) { policy.golden[1][5].place.north = Meters{north}; });
  };
  EXPECT_EQ(place(-0.1), PolicyFault::kOutOfRange);
  EXPECT_EQ(place(25'000.1), PolicyFault::kOutOfRange);
  EXPECT_EQ(place(kNan), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.golden[0][0].reception.snr = Decibels{kNan}; }), PolicyFault::kOutOfRange);
}

TEST(PolicyCheck, RefusesWeightsThatAreNotFinite) {
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(1).bias[2] = kNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(0).weight(4, 1) = kNan; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(0).weight(5, 0) = kNan; }), PolicyFault::kNone) << "not a weight";
}

TEST(PolicyCheck, RefusesWhatCouldOverflowForSomeObservation) {
  // Of three units with tanh <= 1: |logit| <= 3 |w| + |b|, which may be 1e30. The golden searches alone would not find it.
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(2).weight(1, 1) = 0.9e30F; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(2).weight(1, 1) = -1.1e30F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(1).bias[0] = 1.1e30F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(0).weight(0, 0) = 1.1e30F; }), PolicyFault::kUnbounded);
  // A place in an area of 25 km x 26 km is within 103 km whatever it is measured from: scaled by more than 1e4 it could pass 1e9.
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[0].scale = 1e5F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.observation.spec[0].offset = -3e38F; }), PolicyFault::kUnbounded);
}

/// By hand: no place north is farther than 103 km from where it is measured, which makes an element of (103 + 13) / 13 = 8.92; a unit of it
/// is at most 4.46e14 where its weight is 5e13; then 4.46e28, and 4.46e29 or 1.8e30.
TEST(PolicyCheck, BoundsWhatComesOfLayersWithReluByAllWeightsBefore) {
  const auto fault_of = [](Activation activation, float last) {
    return fault_after([activation, last](FrozenPolicy& policy) {
      std::ranges::fill(policy.network.numbers, 0.0F);
      policy.network.activation = activation;
      policy.network.layer(0).weight(4, 1) = 5e13F;
      policy.network.layer(1).weight(2, 4) = 1e14F;
      policy.network.layer(2).weight(3, 2) = last;
    });
  };
  EXPECT_EQ(fault_of(Activation::kRelu, 10.0F), PolicyFault::kNone);
  EXPECT_EQ(fault_of(Activation::kRelu, 40.0F), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_of(Activation::kTanh, 40.0F), PolicyFault::kNone);
}

TEST(PolicyCheck, LetsPassNoWeightsWhoseLogitsOverflowAnywhereInTheArea) {
  // The largest weights that may fly, all of one sign, in the corner where every element is largest.
  auto policy = small_policy();
  for (ObservationElement& element : policy->observation.spec) element = {.feature = element.feature, .offset = 0.0F, .scale = 9e3F};
  std::ranges::fill(policy->network.layer(0).packed, 5e20F);
  std::ranges::fill(policy->network.layer(1).packed, 1.9e29F);
  std::ranges::fill(policy->network.layer(2).packed, 3.2e29F);
  ASSERT_TRUE(check(*policy).is_none());
  for (GoldenStep& step : policy->golden[0]) step.place = policy->area_size;
  record(*policy);
  EXPECT_TRUE(repeats(*policy));
  for (const float logit : policy->golden[0][5].logits) EXPECT_TRUE(is_finite(logit));
}

/// small_policy() whose second element is a feature of that age; what it sees of a belief is there.
PolicyFault fault_of_element(Feature feature, std::size_t age) {
  return fault_after(
      [=](FrozenPolicy& policy) { policy.observation.spec[1] = {.feature = feature, .age = static_cast<std::uint8_t>(age)}; },
      *believing_policy());
}

TEST(PolicyCheck, RefusesAnAgeOnePastTheLastStepOrAction) {
  for (const Feature step : {Feature::kStepEast, Feature::kStepNorth, Feature::kStepSnr}) {
    EXPECT_EQ(fault_of_element(step, 20), PolicyFault::kNone);  // 21 steps are remembered
    EXPECT_EQ(fault_of_element(step, 21), PolicyFault::kBadShape);
    EXPECT_EQ(fault_of_element(step, 255), PolicyFault::kBadShape);
  }
  for (auto feature = static_cast<int>(Feature::kFound); feature <= static_cast<int>(Feature::kApproach); ++feature) {
    EXPECT_EQ(fault_of_element(static_cast<Feature>(feature), 3), PolicyFault::kNone) << feature;  // of four actions
    EXPECT_EQ(fault_of_element(static_cast<Feature>(feature), 4), PolicyFault::kBadShape) << feature;
  }
  for (const Feature one :
       {Feature::kEast, Feature::kNorth, Feature::kToSouthEdge, Feature::kToEastEdge, Feature::kLikeliestEast, Feature::kEffectiveCells}) {
    EXPECT_EQ(fault_of_element(one, 0), PolicyFault::kNone);
    EXPECT_EQ(fault_of_element(one, 1), PolicyFault::kBadShape);
  }
}

TEST(PolicyCheck, KnowsNoFeatureBetweenThoseThereAre) {
  for (const int unknown : {0, 10, 15, 23, 24, 31, 39, 255})
    EXPECT_EQ(fault_of_element(static_cast<Feature>(unknown), 0), PolicyFault::kUnknownFeature) << unknown;
}

TEST(PolicyCheck, DoesNotLookAtABeliefThatNoElementSees) {
  const auto spoil = [](FrozenPolicy& policy) {
    policy.observation.belief = BeliefModel{};
    policy.observation.belief.step_length = Meters{kNan};
    policy.observation.belief.outlier_share = kNan;
  };
  EXPECT_EQ(fault_after(spoil), PolicyFault::kNone);
  EXPECT_EQ(fault_after(spoil, *believing_policy()), PolicyFault::kBadShape);
}

PolicyFault fault_in_advice(const std::function<void(ObservationSpec&)>& damage) {
  return fault_after(
      [&damage](FrozenPolicy& policy) {
        damage(policy.observation.spec);
        policy.network.observation_size = policy.observation.spec.size();
      },
      *advising_policy());
}

/// Of advising_policy(): the spread, then the preferences of its four actions.
TEST(PolicyCheck, WantsEveryPreferenceOnceAndOnOneScaleWhereThereIsNoNetwork) {
  EXPECT_EQ(fault_in_advice([](ObservationSpec&) {}), PolicyFault::kNone);
  EXPECT_EQ(fault_in_advice([](ObservationSpec& spec) { spec[2].feature = Feature::kFindProbability; }), PolicyFault::kNoAdvice)
      << "one is missing";
  EXPECT_EQ(fault_in_advice([](ObservationSpec& spec) { spec[2].age = 1; }), PolicyFault::kNoAdvice) << "one twice, one missing";
  const auto add_one_more = [](ObservationSpec& spec) { static_cast<void>(spec.push_back({.feature = Feature::kPreference, .age = 2})); };
  EXPECT_EQ(fault_in_advice(add_one_more), PolicyFault::kNoAdvice) << "one twice";
  const auto add_on_another_scale = [](ObservationSpec& spec) {
    static_cast<void>(spec.push_back({.feature = Feature::kPreference, .age = 2, .offset = 0.5F, .scale = 2.0F}));
  };
  EXPECT_EQ(fault_in_advice(add_on_another_scale), PolicyFault::kNoAdvice) << "one twice, on scales of their own";
  EXPECT_EQ(fault_in_advice([](ObservationSpec& spec) { spec[4].scale = 1.5F; }), PolicyFault::kNoAdvice) << "another scale";
  EXPECT_EQ(fault_in_advice([](ObservationSpec& spec) { spec[4].offset = 0.5F; }), PolicyFault::kNoAdvice) << "another offset";
  const auto scale_all = [](float scale) {
    return [scale](ObservationSpec& spec) {
      for (std::size_t i = 1; i < 5; ++i) spec[i].scale = scale, spec[i].offset = 0.5F;
    };
  };
  EXPECT_EQ(fault_in_advice(scale_all(2.0F)), PolicyFault::kNone);
  for (const float scale : {0.0F, -1.0F}) EXPECT_EQ(fault_in_advice(scale_all(scale)), PolicyFault::kNoAdvice) << "the worst would be best";
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.hidden_sizes = {}; }), PolicyFault::kNoAdvice) << "it sees no belief";
}

TEST(PolicyCheck, NamesTheObservationWhereAdviceIsMissing) {
  const auto policy = advising_policy();
  policy->observation.spec[1].feature = Feature::kFindProbability;
  EXPECT_EQ(check(*policy).section, kObservationSection);
}

TEST(PolicyCheck, JudgesSizesAndBoundsWithoutANetworkToo) {
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.observation_size = 4; }, *advising_policy()), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.action_count = 3; }, *advising_policy()), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_advice([](ObservationSpec& spec) { spec[0].scale = 1e5F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_in_advice([](ObservationSpec& spec) { spec[1].age = 4; }), PolicyFault::kBadShape);
}

TEST(PolicyCheck, RefusesEdgesThatAreThoseOfAnotherArea) {
  for (const Feature edge : {Feature::kToNorthEdge, Feature::kToEastEdge}) {
    const auto see_the_edge = [edge](FrozenPolicy& policy) { policy.observation.spec[1] = {.feature = edge}; };
    EXPECT_EQ(fault_after(see_the_edge), PolicyFault::kBadShape) << "the belief's area is not the policy's";
    EXPECT_EQ(fault_after([&](FrozenPolicy& policy) {
                see_the_edge(policy);
                policy.observation.belief.area_size = policy.area_size;
              }),
              PolicyFault::kNone);
  }
}

TEST(PolicyCheck, RefusesABeliefAboutAnotherSearch) {
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.area_size.north = Meters{25'001}; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.area_size.east = Meters{25'999}; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.detection_threshold = Decibels{-3.4}; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { m.actions[3] = {-0.6, 0.8}; }), PolicyFault::kBadShape);
  EXPECT_EQ(fault_in_belief([](BeliefModel& m) { static_cast<void>(m.actions.push_back({1, 0})); }), PolicyFault::kBadShape);
}

/// The most that each feature can be, either side of zero, for believing_policy(): an area of 25 km x 26 km, steps of 1 km, a border of
/// 700 m, a regret of at most 9. A length: out of the area by a step, and across it, 2 (25 + 26) km + 1 km.
TEST(PolicyCheck, BoundsEveryFeatureByTheMostThatItCanBe) {
  const auto most_of = [](Feature feature) {
    switch (feature) {
      case Feature::kStepSnr:
        return 600.0;
      case Feature::kEffectiveCells:
        return 5'000.0;  // twice as many as there can be
      case Feature::kLikeliestShare:
      case Feature::kFound:
      case Feature::kFindProbability:
      case Feature::kDetected:
      case Feature::kPreference:
        return 2.0;  // twice a probability
      case Feature::kBorder:
        return 1.0 + 10.0 / 7.0;
      case Feature::kRegret:
        return 9.0;
      default:
        return 103'000.0;
    }
  };
  for (int number = 0; number < 256; ++number) {
    const auto feature = static_cast<Feature>(number);
    if (!is_known(feature)) continue;
    const auto fault_when = [&](double share) {  // of the largest scale that is let pass, with an offset of half of what the feature is
      return fault_after(
          [&](FrozenPolicy& policy) {
            policy.observation.spec[1] = {.feature = feature,
                                          .offset = static_cast<float>(-0.5 * most_of(feature)),
                                          .scale = static_cast<float>(-share * 1e9 / (1.5 * most_of(feature)))};
          },
          *believing_policy());
    };
    EXPECT_EQ(fault_when(0.999), PolicyFault::kNone) << number;
    EXPECT_EQ(fault_when(1.001), PolicyFault::kUnbounded) << number;
  }
}

TEST(PolicyCheck, BoundsAHiddenUnitByTheLargestElementThatItSees) {
  const auto fault_with = [](float weight) {
    return fault_after([weight](FrozenPolicy& policy) {
      for (ObservationElement& element : policy.observation.spec) element = {.feature = Feature::kEast, .scale = 1e-6F};
      policy.network.layer(0).weight(2, 1) = weight;  // no element is greater than 0.103
    });
  };
  EXPECT_EQ(fault_with(9.6e30F), PolicyFault::kNone);
  EXPECT_EQ(fault_with(-9.8e30F), PolicyFault::kUnbounded);
}

TEST(PolicyCheck, LetsPassTheLargestOfEverythingAndNothingBeyond) {
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.step_length = Meters{1e6}; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.area_size.north = Meters{1e7}; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.area_size.north = Meters{1.0001e7}; }), PolicyFault::kOutOfRange);
  for (const double threshold : {-600.0, 600.0})
    EXPECT_EQ(fault_after([threshold](FrozenPolicy& policy) { policy.detection_threshold = Decibels{threshold}; }), PolicyFault::kNone);
  // A direction is of length one to nine places.
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0] = {1.0 + 4e-10, 0.0}; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0] = {1.0 + 6e-10, 0.0}; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0] = {0.0, 1.0 - 6e-10}; }), PolicyFault::kNotFinite);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.actions[0] = {0.6, 0.6}; }), PolicyFault::kNotFinite);
}

TEST(PolicyCheck, LetsGoldenSearchesGoUpToTheEdges) {
  const auto fault_at = [](double north, double east, double snr) {
    return fault_after([=](FrozenPolicy& policy) {
      policy.golden[0][0].place = {.north = Meters{north}, .east = Meters{east}};
      policy.golden[0][0].reception.snr = Decibels{snr};
    });
  };
  EXPECT_EQ(fault_at(0.0, 0.0, -600.0), PolicyFault::kNone);
  EXPECT_EQ(fault_at(25'000.0, 26'000.0, 600.0), PolicyFault::kNone);
  EXPECT_EQ(fault_at(0.0, -0.1, 0.0), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_at(0.0, 26'000.1, 0.0), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_at(0.0, 0.0, 600.1), PolicyFault::kOutOfRange);
  EXPECT_EQ(fault_at(0.0, 0.0, -600.1), PolicyFault::kOutOfRange);
}

TEST(PolicyCheck, LetsPassTheSmallestNetworkAndNoneSmaller) {
  const auto shrink = [](std::size_t size) {
    return [size](FrozenPolicy& policy) {
      policy.network.observation_size = policy.network.action_count = size;
      policy.network.hidden_sizes = {size, size};
      const ObservationElement element = policy.observation.spec[0];
      const UnitNorthEast direction = policy.actions[0];
      policy.observation.spec.clear();
      policy.actions.clear();
      for (std::size_t i = 0; i < size; ++i) {
        static_cast<void>(policy.observation.spec.push_back(element));
        static_cast<void>(policy.actions.push_back(direction));
      }
    };
  };
  EXPECT_EQ(fault_after(shrink(1)), PolicyFault::kNone);
  EXPECT_EQ(fault_after(shrink(0)), PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.observation_size = 0, policy.observation.spec.clear(); }),
            PolicyFault::kBadShape);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.action_count = 0, policy.actions.clear(); }), PolicyFault::kBadShape);
}

TEST(PolicyCheck, SaysNothingAboutAGoodPolicy) {
  const PolicyComplaint complaint = check(*small_policy());
  EXPECT_EQ(complaint.fault, PolicyFault::kNone);
  EXPECT_EQ(complaint.section, SectionTag{});
  EXPECT_EQ(complaint.version, 0U);
}

TEST(PolicyCheck, RefusesAWindowThatCannotBeListenedOver) {
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) {
              policy.observation.listening = {config::Listening::kNewest, Duration::seconds(1)};
            }),
            PolicyFault::kUnknownListening);
}

TEST(PolicyCheck, LooksAtEveryWeightAndAtNothingElse) {
  // Layers of 5 x 2, 3 x 5 and 4 x 3: the last weight of each, and the first beyond.
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(1).weight(2, 4) = 1.1e30F; }), PolicyFault::kUnbounded);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(1).weight(2, 4) = 0.995e30F; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(2).weight(3, 2) = -0.995e30F; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(0).weight(5, 0) = kNan; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(1).weight(3, 4) = kNan; }), PolicyFault::kNone);
  EXPECT_EQ(fault_after([](FrozenPolicy& policy) { policy.network.layer(2).weight(4, 2) = kNan; }), PolicyFault::kNone);
}

TEST(PolicyCheck, LetsPassAnElementOfExactlyTheMost) {
  const auto scaled_by = [](float scale) {
    return [scale](FrozenPolicy& policy) { policy.observation.spec[1] = {.feature = Feature::kLikeliestShare, .scale = scale}; };
  };
  EXPECT_EQ(fault_after(scaled_by(5e8F), *believing_policy()), PolicyFault::kNone);  // 2 5e8 = 1e9
  EXPECT_EQ(fault_after(scaled_by(5.00001e8F), *believing_policy()), PolicyFault::kUnbounded);
}

}  // namespace
}  // namespace earshot::policy
