#include "policy/baselines/learned.hpp"

#include <array>
#include <span>

namespace earshot::baselines {

void Learned::begin(Pcg32 random) {
  random_ = random;
  is_first_ = true;
  fallback_.start();
}

std::size_t Learned::choose(const DecisionInput& input) {
  const NorthEast place = input.position - domain_.south_west;
  if (is_first_) {
    memory_.start(policy_.observation, tables_, place, input.reception);
  } else {
    memory_.remember(policy_.observation, tables_, place, input.reception);
  }
  is_first_ = false;
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
  const std::span<float> seen = std::span(observation).first(policy_.observation.spec.size());
  const std::span<float> scores = std::span(logits).first(policy_.actions.size());
  policy::observe(memory_, policy_.observation, seen);
  policy::find_logits(policy_, seen, scores);
  const std::size_t action = policy::draw_action(draw_, scores, random_);
  const guidance::SweepPlan plan{.area = domain_, .margin = edge_margin_, .step_length = policy_.step_length};
  const bool calls_for_sweep = policy::needs_belief(policy_.observation.spec) && memory_.belief().calls_for_sweep();
  return fallback_.choose(calls_for_sweep, action, plan, input.position, std::span(policy_.actions.begin(), policy_.actions.size()));
}

void Learned::refine() {
  while (memory_.refine(policy_.observation, tables_)) {
  }
}

std::optional<bool> Learned::declares_found() const {
  if (!policy::needs_belief(policy_.observation.spec)) return std::nullopt;
  return memory_.belief().declaration().has_value();
}

std::optional<bool> Learned::is_mismatched() const {
  if (!policy::needs_belief(policy_.observation.spec)) return std::nullopt;
  return memory_.belief().model_mismatch().is_mismatched();
}

}  // namespace earshot::baselines
