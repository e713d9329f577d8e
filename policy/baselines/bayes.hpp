#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "firmware/policy/belief.hpp"
#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

/// Keeps a belief over the source's place (firmware/policy/belief) and goes to the likeliest cell, looking one step ahead at the border.
class Bayes : public Searcher {
 public:
  explicit Bayes(const PriorKnowledge& prior);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 protected:
  /// Takes a measurement into the belief.
  void hear(const DecisionInput& input);
  [[nodiscard]] std::size_t chase(const DecisionInput& input) const;
  /// Centre of a cell in the domain's frame.
  [[nodiscard]] NorthEast centre_of(std::size_t north, std::size_t east) const;

  const PriorKnowledge& prior_;
  policy::BeliefModel model_;
  policy::Belief belief_;
};

/// Takes the action of least regret (policy::ActionOutlook), the belief's own advice: what a learned policy that sees it must better.
class BayesLeastRegret : public Bayes {
 public:
  explicit BayesLeastRegret(const PriorKnowledge& prior) : Bayes(prior) {}
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;
};

/// Takes the step whose measurement is expected to tell most about the source's place, until one step length around a place covers the
/// belief; then chases it as Bayes does.
///
///   I = H(Z) - H(Z | place)   over the outcomes Z of the step: found, or an SNR in bins of 2 dB, in nats; less the border's cost
///
/// Oracle: InformationGain.*
class BayesInformationGain : public Bayes {
 public:
  explicit BayesInformationGain(const PriorKnowledge& prior) : Bayes(prior) {}
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

  /// Expected information of a measurement at a place (in the domain's frame) under the belief now.
  [[nodiscard]] double information_at(NorthEast place) const;

 private:
  [[nodiscard]] double spread_db() const;
};

}  // namespace earshot::baselines
