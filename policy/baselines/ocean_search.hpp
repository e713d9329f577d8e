#pragma once

#include <cstddef>
#include <memory>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

/// Keeps a belief over the source's place and the ocean together (firmware/policy/ocean_belief) and takes the action of least regret.
/// It believes the SNR against range that is expected as likely as all PriorKnowledge::oceans together.
class OceanSearch : public Searcher {
 public:
  explicit OceanSearch(const PriorKnowledge& prior);
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 protected:
  /// Takes a measurement into the belief.
  void hear(const DecisionInput& input);

  const PriorKnowledge& prior_;
  std::unique_ptr<policy::OceanTables> tables_;
  policy::BeliefModel model_;
  std::unique_ptr<policy::OceanBelief> belief_;
};

}  // namespace earshot::baselines
