#include "policy/explain/decision_account.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <memory>

#include "firmware/policy/action_draw.hpp"

namespace earshot::explain {
namespace {

std::vector<ActionAccount> actions_of(const Circumstances& c, const RecordedDecision& decision, const policy::OceanBelief& belief,
                                      const BelievedPlace& place) {
  const ExpectedSound sound(belief, c.tables);
  std::vector<float> probabilities(decision.action_logits().size());
  policy::softmax(decision.action_logits(), probabilities);
  std::vector<ActionAccount> actions;
  for (std::size_t a = 0; a < probabilities.size(); ++a) {
    const NorthEast end = decision.position + c.policy.step_length * c.policy.actions[a];
    const policy::ActionValues& values = belief.action_values(a);
    actions.push_back({.name = direction_name(c.policy.actions[a]),
                       .probability = static_cast<double>(probabilities[a]),
                       .end = end,
                       .hear = expected_hearing(place, sound, end - c.south_west),
                       .detected = static_cast<double>(values.detected),
                       .found = static_cast<double>(values.found),
                       .found_soon = static_cast<double>(values.find_probability),
                       .approach = expected_approach(place, decision.position - c.south_west, end - c.south_west),
                       .border = static_cast<double>(values.border)});
  }
  return actions;
}

/// Of a policy without a network, whose choice rests on nothing else.
void note_worths(const Circumstances& c, const RecordedDecision& decision, std::vector<ActionAccount>& actions) {
  if (policy::has_network(c.policy.network)) return;
  for (std::size_t i = 0; i < decision.observed().size(); ++i) {
    const policy::ObservationElement& element = c.policy.observation.spec[i];
    if (element.feature != policy::Feature::kPreference || element.age >= actions.size()) continue;
    actions[element.age].worth =
        static_cast<double>(decision.observed()[i]) / static_cast<double>(element.scale) + static_cast<double>(element.offset);
  }
}

std::vector<HypothesisAccount> hypotheses_of(const policy::OceanBelief& belief, const policy::OceanTables& tables) {
  constexpr double kLeastShare = 0.01;
  std::vector<HypothesisAccount> hypotheses;
  for (std::size_t h = 0; h < policy::OceanBelief::kHypotheses; ++h) {
    const double share = static_cast<double>(belief.share(h));
    if (share < kLeastShare) continue;
    const policy::Hypothesis& hypothesis = belief.hypothesis(h);
    const auto& name = tables.tables[hypothesis.table].name;
    hypotheses.push_back({.ocean = {name.begin(), name.end()},
                          .level_db = static_cast<double>(policy::kLevelOffsets_db[hypothesis.level]),
                          .spread_db = static_cast<double>(policy::kSpreads_db[hypothesis.spread]),
                          .silence_share = static_cast<double>(policy::kSilenceShares[hypothesis.silence]),
                          .is_moving = hypothesis.mobility > 0,
                          .share = share});
  }
  std::ranges::stable_sort(hypotheses, std::ranges::greater{}, &HypothesisAccount::share);
  return hypotheses;
}

void attribute(const Circumstances& c, DecisionAccount& account) {
  const RecordedDecision& decision = account.decision;
  const NorthEast size = c.policy.area_size;
  const NorthEast place = c.baseline == Baseline::kHere ? decision.position - c.south_west : NorthEast{size.north / 2.0, size.east / 2.0};
  const std::vector<float> compared = uninformed_observation(c.policy.observation, c.tables, place, c.policy.detection_threshold);
  const std::span<const float> seen = decision.observed();
  const std::vector<double> observation(seen.begin(), seen.end());
  const std::vector<double> baseline(compared.begin(), compared.end());
  account.attribution = integrated_gradients(c.policy, {.observation = observation, .baseline = baseline}, decision.action);
  for (std::size_t i = 0; i < observation.size(); ++i) {
    const policy::ObservationElement& element = c.policy.observation.spec[i];
    account.observed.push_back({.subject = subject_of(element.feature),
                                .name = name_of(element, c.policy.actions),
                                .value = value_of(element, seen[i]),
                                .baseline = value_of(element, compared[i]),
                                .part = account.attribution.parts[i]});
  }
}

}  // namespace

DecisionAccount account_of(const Circumstances& c, const RecordedDecision& decision, const policy::OceanBelief& belief) {
  DecisionAccount account;
  account.decision = decision;
  account.detection_threshold = c.policy.detection_threshold;
  account.area = {.south_west = c.south_west, .north_east = c.south_west + c.policy.area_size};
  account.belief_is_the_policys = c.belief_is_the_policys;
  account.uses_measurements = uses_measurements(c.policy.observation.spec);
  account.place = believed_place(belief, c.belief);
  account.hypotheses = hypotheses_of(belief, c.tables);
  account.actions = actions_of(c, decision, belief, account.place);
  note_worths(c, decision, account.actions);
  account.likeliest_action =
      static_cast<std::size_t>(std::ranges::max_element(account.actions, {}, &ActionAccount::probability) - account.actions.begin());
  account.most_regret_steps = static_cast<double>(c.belief.costs.most_regret);
  account.draw = c.policy.draw;
  account.baseline = c.baseline;
  attribute(c, account);
  return account;
}

DecisionAccount account_of(const Circumstances& c, std::span<const RecordedDecision> decisions) {
  assert(!decisions.empty());
  const auto belief = std::make_unique<policy::OceanBelief>();
  belief->start(c.belief, c.tables);
  for (const RecordedDecision& decision : decisions)
    belief->update(c.belief, c.tables, decision.position - c.south_west, decision.reception());
  return account_of(c, decisions.back(), *belief);
}

std::vector<ObservedAccount> weightiest(const DecisionAccount& account, std::size_t count) {
  std::vector<ObservedAccount> sorted = account.observed;
  std::ranges::stable_sort(sorted, [](const ObservedAccount& a, const ObservedAccount& b) { return std::abs(a.part) > std::abs(b.part); });
  sorted.resize(std::min(count, sorted.size()));
  return sorted;
}

}  // namespace earshot::explain
