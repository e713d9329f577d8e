#pragma once

#include <cstddef>
#include <optional>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

/// Keeps a belief over the source's place (firmware/policy/ocean_belief), in the ocean that it was told of, and goes to the likeliest cell,
/// looking one step ahead at the border.
class Bayes : public Searcher {
 public:
  explicit Bayes(const PriorKnowledge& prior);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;
  void refine() override;

  [[nodiscard]] std::optional<bool> declares_found() const override { return belief_.declaration().has_value(); }
  [[nodiscard]] std::optional<bool> is_mismatched() const override { return belief_.model_mismatch().is_mismatched(); }

 protected:
  /// Takes a measurement into the belief.
  void hear(const DecisionInput& input);

  const PriorKnowledge& prior_;
  policy::BeliefModel model_;
  policy::OceanTables tables_;
  policy::OceanBelief belief_;
};

/// Takes the action of least regret (policy::ActionValues), the belief's own advice: what a learned policy that sees it must better.
class BayesLeastRegret : public Bayes {
 public:
  explicit BayesLeastRegret(const PriorKnowledge& prior) : Bayes(prior) {}
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;
};

/// The same among all oceans that are believed possible, where Bayes believes in the one that it was told of.
class OceanSearch : public BayesLeastRegret {
 public:
  explicit OceanSearch(const PriorKnowledge& prior);
};

}  // namespace earshot::baselines
