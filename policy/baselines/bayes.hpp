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
  explicit Bayes(const Briefing& briefing);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const Look& look) override;

 protected:
  /// Takes a look into the belief.
  void hear(const Look& look);
  [[nodiscard]] std::size_t chase(const Look& look) const;
  /// Centre of a cell in the domain's frame.
  [[nodiscard]] NorthEast centre_of(std::size_t north, std::size_t east) const;

  const Briefing& briefing_;
  policy::BeliefModel model_;
  policy::Belief belief_;
};

/// Takes the action of least regret (policy::ActionOutlook), the belief's own advice: what a learned policy that sees it must better.
class BayesLeastRegret : public Bayes {
 public:
  explicit BayesLeastRegret(const Briefing& briefing) : Bayes(briefing) {}
  [[nodiscard]] std::size_t choose(const Look& look) override;
};

/// Takes the step whose look is expected to tell most about the source's place, until the belief has shrunk to what one look covers; then
/// chases it as Bayes does.
///
///   I = H(Z) - H(Z | place)   over what may come of the look: found, or an SNR in bins of 2 dB, in nats; less the border's cost
///
/// Oracle: InformationGain.*
class BayesInformationGain : public Bayes {
 public:
  explicit BayesInformationGain(const Briefing& briefing) : Bayes(briefing) {}
  [[nodiscard]] std::size_t choose(const Look& look) override;

  /// Expected information of a look at a place (in the domain's frame) under the belief now.
  [[nodiscard]] double information_at(NorthEast place) const;

 private:
  [[nodiscard]] double spread_db() const;
};

}  // namespace earshot::baselines
