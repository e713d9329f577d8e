#include "policy/baselines/bayes.hpp"

#include <ranges>

#include "policy/baselines/moves.hpp"
#include "sim/search/belief_model.hpp"
#include "sim/search/known_ocean.hpp"

namespace earshot::baselines {

Bayes::Bayes(const PriorKnowledge& prior) : prior_(prior), model_(search::belief_model(prior.settings)) {
  search::make_known_ocean(prior.settings, prior.snr, tables_);
}

void Bayes::begin(Pcg32 /*random*/) {
  belief_.start(model_, tables_);
}

void Bayes::refine() {
  while (belief_.refine(model_, tables_)) {
  }
}

void Bayes::hear(const DecisionInput& input) {
  belief_.update(model_, tables_, input.position - prior_.settings.domain.south_west, input.reception);
}

std::size_t Bayes::choose(const DecisionInput& input) {
  hear(input);
  return warily_toward(prior_, input.position, prior_.settings.domain.south_west + belief_.summary().likeliest);
}

std::size_t BayesLeastRegret::choose(const DecisionInput& input) {
  hear(input);
  const auto regret = [this](std::size_t action) { return belief_.action_values(action).regret; };
  return std::ranges::min(std::views::iota(std::size_t{0}, model_.actions.size()), {}, regret);
}

OceanSearch::OceanSearch(const PriorKnowledge& prior) : BayesLeastRegret(prior) {
  tables_ = prior.oceans;
}

}  // namespace earshot::baselines
