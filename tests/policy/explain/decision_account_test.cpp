#include "policy/explain/decision_account.hpp"

#include "policy/explain/decision_follower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "tests/policy/explain/flown_policy.hpp"

namespace earshot::explain {
namespace {

constexpr NorthEast kCorner{Meters{-3'000.0}, Meters{750.0}};

DecisionAccount account(const policy::FrozenPolicy& policy, std::span<const RecordedDecision> taken, Baseline baseline) {
  return account_of(
      {.policy = policy, .belief = policy.observation.belief, .tables = falling_ocean(), .south_west = kCorner, .baseline = baseline},
      taken);
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

/// Five measurements on a line leave the source on either side of it; it is heard better the nearer one comes.
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
  double of_all = 0.0;
  for (const ObservedAccount& seen : a.observed) of_all += seen.part;
  EXPECT_NEAR(of_all, a.attribution.difference(), kCompleteness);
  const std::vector<ObservedAccount> top = weightiest(a, 3);
  ASSERT_EQ(top.size(), 3U);
  EXPECT_GE(std::abs(top[0].part), std::abs(top[1].part));
  EXPECT_GE(std::abs(top[1].part), std::abs(top[2].part));
}

/// Of a policy without a network nothing but what it goes by can have moved the choice: the actions' preferences.
TEST(DecisionAccount, BlamesTheChoiceOfAPolicyWithoutANetworkOnItsPreferencesAlone) {
  const auto policy = advice_policy();
  const DecisionAccount a = account(*policy, flown(*policy, 4, kCorner), Baseline::kCentre);
  EXPECT_TRUE(a.attribution.is_complete());
  EXPECT_GT(std::abs(a.attribution.difference()), 0.01);
  for (std::size_t i = 0; i < a.observed.size(); ++i) {
    if (policy->observation.spec[i].feature == policy::Feature::kPreference) continue;
    EXPECT_EQ(a.observed[i].part, 0.0) << a.observed[i].name;
  }
}

/// Its tables hold one ocean, where the source is as loud as they say.
TEST(DecisionAccount, OfAPolicyWithoutANetworkTellsWhatEachActionIsWorthAndOfATrainedOneNot) {
  const auto policy = advice_policy();
  const std::vector<RecordedDecision> decisions = flown(*policy, 4, {});
  const DecisionAccount account =
      account_of({.policy = *policy, .belief = policy->observation.belief, .tables = falling_ocean(), .south_west = {}}, decisions);
  double best = 0.0;
  std::size_t preferences = 0;
  for (std::size_t i = 0; i < policy->observation.spec.size(); ++i) {
    const policy::ObservationElement& element = policy->observation.spec[i];
    if (element.feature != policy::Feature::kPreference) continue;
    ++preferences;
    const std::optional<double> worth = account.actions.at(element.age).worth;
    ASSERT_TRUE(worth);
    EXPECT_NEAR(*worth, static_cast<double>(decisions.back().observation[i]) / 10.0, 1e-6) << "shown ten times as large";
    best = std::max(best, *worth);
  }
  EXPECT_EQ(preferences, account.actions.size());
  EXPECT_NEAR(best, 1.0, 1e-6);
  const auto trained = belief_policy(1);
  const std::vector<RecordedDecision> others = flown(*trained, 2, {});
  EXPECT_FALSE(account_of({.policy = *trained, .belief = trained->observation.belief, .tables = falling_ocean(), .south_west = {}}, others)
                   .actions[0]
                   .worth);
}

TEST(DecisionAccount, NamesTheHypothesesThatAreLikelyTheLikeliestFirst) {
  const auto policy = belief_policy(1);
  const DecisionAccount a = account(*policy, flown(*policy, 5, kCorner), Baseline::kCentre);
  ASSERT_FALSE(a.hypotheses.empty());
  EXPECT_LE(a.hypotheses.size(), policy::OceanBelief::kHypotheses);
  double sum = 0.0;
  for (const HypothesisAccount& h : a.hypotheses) {
    EXPECT_EQ(h.ocean, "falling");
    EXPECT_GE(h.share, 0.01);
    EXPECT_LE(h.share, a.hypotheses.front().share);
    sum += h.share;
  }
  EXPECT_LE(sum, 1.0 + 1e-5);  // as many float roundings as there are hypotheses
  EXPECT_GT(sum, 1.0 - 0.01 * static_cast<double>(policy::OceanBelief::kHypotheses));
  EXPECT_TRUE(std::ranges::is_sorted(a.hypotheses, std::ranges::greater{}, &HypothesisAccount::share));
}

/// An ocean that is as loud everywhere, and ten measurements 6 dB louder than it.
TEST(DecisionAccount, TellsWhatAHypothesisSays) {
  const auto policy = belief_policy(1);
  auto flat = std::make_unique<policy::OceanTables>(falling_ocean());
  flat->tables[0].snr_half_db.fill(policy::to_half_db(10.0));  // the same everywhere
  std::vector<RecordedDecision> taken = flown(*policy, 10, kCorner);
  for (RecordedDecision& decision : taken) {
    decision.snr = Decibels{16.0};
    decision.too_faint = false;
  }
  const DecisionAccount a =
      account_of({.policy = *policy, .belief = policy->observation.belief, .tables = *flat, .south_west = kCorner}, taken);
  // Ten times 16.0 dB where the ocean gives 10: 6 dB louder, and nothing else moves it by more than a decibel.
  EXPECT_EQ(a.hypotheses.front().level_db, 6.0);
  EXPECT_EQ(a.hypotheses.front().spread_db, 1.0);
  EXPECT_EQ(a.hypotheses.front().silence_share, 0.0);
  EXPECT_FALSE(a.hypotheses.front().is_moving);
  EXPECT_GT(a.hypotheses.front().share, 0.5);
}

/// The same place, compared with itself: where the vehicle is can have moved nothing.
TEST(DecisionAccount, BlamesNothingOnThePlaceWhenComparedWithTheSamePlace) {
  const auto policy = place_policy(1);
  const auto observer = belief_policy(1);
  const std::vector<RecordedDecision> taken = flown(*policy, 3, kCorner);
  const Circumstances here{.policy = *policy,
                           .belief = observer->observation.belief,
                           .tables = falling_ocean(),
                           .belief_is_the_policys = false,
                           .south_west = kCorner,
                           .baseline = Baseline::kHere};
  EXPECT_EQ(account_of(here, taken).attribution.sum(), 0.0);
  Circumstances centre = here;
  centre.baseline = Baseline::kCentre;
  EXPECT_GT(std::abs(account_of(centre, taken).attribution.difference()), 1e-3);
  EXPECT_FALSE(account_of(centre, taken).belief_is_the_policys);
}

/// The searches of a policy with a belief and of one that an observer stands in for, one after the other.
TEST(DecisionFollower, ExplainsEachDecisionAsThoseBeforeItAloneDoAndBeginsAnew) {
  const auto observed = belief_policy(1);
  for (const bool holds_belief : {true, false}) {
    const auto policy = holds_belief ? belief_policy(2) : place_policy(1);
    const std::vector<RecordedDecision> taken = flown(*policy, 4, kCorner);
    const Circumstances circumstances{.policy = *policy,
                                      .belief = holds_belief ? policy->observation.belief : observed->observation.belief,
                                      .tables = falling_ocean(),
                                      .belief_is_the_policys = holds_belief,
                                      .south_west = kCorner};
    DecisionFollower follower(circumstances);
    for (const int search : {1, 2}) {
      for (std::size_t i = 0; i < taken.size(); ++i) {
        follower.follow(taken[i]);
        EXPECT_EQ(follower.contradiction(taken[i]), Contradiction::kNone) << search;
        const DecisionAccount here = follower.account_of(taken[i]);
        const DecisionAccount alone = account_of(circumstances, std::span(taken).first(i + 1));
        EXPECT_EQ(here.attribution.parts, alone.attribution.parts);
        EXPECT_EQ(here.place.probability, alone.place.probability);
      }
    }
  }
}

TEST(UninformedObservation, HasHeardNothing) {
  const auto policy = belief_policy(1);
  const NorthEast centre{Meters{12'500.0}, Meters{12'500.0}};
  const std::vector<float> seen = uninformed_observation(policy->observation, falling_ocean(), centre, policy->detection_threshold);
  const policy::ObservationSpec& spec = policy->observation.spec;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    ASSERT_TRUE(std::isfinite(seen[i])) << name_of(spec[i], policy->actions);
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
  for (const float x : uninformed_observation(model, falling_ocean(), {}, Decibels{10.0}))
    EXPECT_EQ(x, 0.0F);  // memory_state is centred there
}

}  // namespace
}  // namespace earshot::explain
