#include "policy/baselines/learned.hpp"

#include <array>
#include <span>

namespace earshot::baselines {

void Learned::begin(Pcg32 random) {
  random_ = random;
  is_first_ = true;
}

std::size_t Learned::choose(const DecisionInput& input) {
  const NorthEast place = input.position - corner_;
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
  return policy::draw_action(draw_, scores, random_);
}

}  // namespace earshot::baselines
