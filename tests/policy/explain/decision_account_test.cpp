#include "policy/explain/decision_account.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/policy/explain/flown_policy.hpp"

namespace earshot::explain {
namespace {

constexpr NorthEast kCorner{Meters{-3'000.0}, Meters{750.0}};

DecisionAccount account(const policy::FrozenPolicy& policy, std::span<const RecordedDecision> taken, Baseline baseline) {
  return account_of({.policy = policy, .belief = policy.observation.belief, .south_west = kCorner, .baseline = baseline}, taken);
}

TEST(DecisionAccount, GivesProbabilitiesThatAddUpToOneAndEndsOneStepAway) {
  const auto policy = belief_policy(1);
  const std::vector<RecordedDecision> taken = flown(*policy, 5, kCorner);
  const DecisionAccount a = account(*policy, taken, Baseline::kCentre);
  ASSERT_EQ(a.actions.size(), 8U);
  double sum = 0.0;
  for (const ActionAccount& action : a.actions) {
    sum += action.probability;
    EXPECT_NEAR(range_between(action.end, taken.back().position).value, 1'000.0, 1e-6);
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);  // eight float roundings
  EXPECT_EQ(a.likeliest_action, taken.back().action);
}

/// Five looks on a line leave the source on either side of it; it is heard better the nearer one comes.
TEST(DecisionAccount, ExpectsToHearMoreWhereTheBeliefComesNearer) {
  const auto policy = belief_policy(1);
  const DecisionAccount a = account(*policy, flown(*policy, 5, kCorner), Baseline::kCentre);
  const auto towards = std::ranges::max_element(a.actions, {}, [](const ActionAccount& x) { return x.approach; });
  const auto away = std::ranges::min_element(a.actions, {}, [](const ActionAccount& x) { return x.approach; });
  EXPECT_GT(towards->approach.value, 500.0);
  EXPECT_GT(towards->hear.snr, away->hear.snr);
}

TEST(DecisionAccount, SharesOutTheWholeDifferenceAmongWhatWasSeen) {
  const auto policy = belief_policy(2);
  const DecisionAccount a = account(*policy, flown(*policy, 4, kCorner), Baseline::kCentre);
  EXPECT_TRUE(a.attribution.is_complete());
  ASSERT_EQ(a.observed.size(), policy->observation.spec.size());
  double of_subjects = 0.0;
  for (const SubjectAccount& subject : by_subject(a)) of_subjects += subject.part;
  EXPECT_NEAR(of_subjects, a.attribution.difference(), kCompleteness);
  const std::vector<ObservedAccount> top = weightiest(a, 3);
  ASSERT_EQ(top.size(), 3U);
  EXPECT_GE(std::abs(top[0].part), std::abs(top[1].part));
  EXPECT_GE(std::abs(top[1].part), std::abs(top[2].part));
}

/// The same place, compared with itself: where the vehicle is can have moved nothing.
TEST(DecisionAccount, BlamesNothingOnThePlaceWhenComparedWithTheSamePlace) {
  const auto policy = place_policy(1);
  const auto observer = belief_policy(1);
  const std::vector<RecordedDecision> taken = flown(*policy, 3, kCorner);
  const Circumstances here{.policy = *policy,
                           .belief = observer->observation.belief,
                           .belief_is_the_policys = false,
                           .south_west = kCorner,
                           .baseline = Baseline::kHere};
  EXPECT_EQ(account_of(here, taken).attribution.sum(), 0.0);
  Circumstances centre = here;
  centre.baseline = Baseline::kCentre;
  EXPECT_GT(std::abs(account_of(centre, taken).attribution.difference()), 1e-3);
  EXPECT_FALSE(account_of(centre, taken).belief_is_the_policys);
}

TEST(DecisionAccount, IsTheSameWhetherOneOrAllDecisionsAreExplained) {
  const auto policy = belief_policy(1);
  const std::vector<RecordedDecision> taken = flown(*policy, 4, kCorner);
  const Circumstances circumstances{.policy = *policy, .belief = policy->observation.belief, .south_west = kCorner};
  const std::vector<DecisionAccount> all = accounts_of(circumstances, taken);
  ASSERT_EQ(all.size(), 4U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const DecisionAccount one = account_of(circumstances, std::span(taken).first(i + 1));
    EXPECT_EQ(one.attribution.parts, all[i].attribution.parts);
    EXPECT_EQ(one.place.probability, all[i].place.probability);
  }
}

TEST(UninformedObservation, HasHeardNothing) {
  const auto policy = belief_policy(1);
  const NorthEast centre{Meters{12'500.0}, Meters{12'500.0}};
  const std::vector<float> seen = uninformed_observation(policy->observation, centre, policy->detection_threshold);
  const policy::ObservationSpec& spec = policy->observation.spec;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    ASSERT_TRUE(std::isfinite(seen[i])) << name_of(spec[i], policy->observation.belief, policy->actions);
    const double raw = static_cast<double>(seen[i]) / static_cast<double>(spec[i].scale) + static_cast<double>(spec[i].offset);
    using enum policy::Feature;
    if (spec[i].feature == kMeanEast || spec[i].feature == kMeanNorth || spec[i].feature == kLikeliestEast ||
        spec[i].feature == kLikeliestNorth) {
      EXPECT_NEAR(raw, 0.0, 10.0);  // m; as much to the one side as to the other
    }
    if (spec[i].feature == kApproach) {
      EXPECT_EQ(raw, 0.0);
    }
  }
}

TEST(UninformedObservation, PutsEveryRememberedSnrAtTheThreshold) {
  policy::ObservationModel model;
  model.spec = policy::memory_state(2, Meters{1'000.0}, Decibels{10.0}).value();
  for (const float x : uninformed_observation(model, {}, Decibels{10.0})) EXPECT_EQ(x, 0.0F);  // memory_state is centred there
}

}  // namespace
}  // namespace earshot::explain
