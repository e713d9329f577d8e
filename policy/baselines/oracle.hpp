#pragma once

#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

enum class Border : bool { kIgnored, kSeenOneStepAhead };

/// Knows where the source is and goes straight to it: what no searcher can be expected to beat by much.
class Oracle : public Searcher {
 public:
  Oracle(const PriorKnowledge& prior, Border border) : prior_(prior), border_(border) {}
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  const PriorKnowledge& prior_;
  Border border_;
};

}  // namespace earshot::baselines
