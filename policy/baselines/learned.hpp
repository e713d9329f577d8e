#pragma once

#include "firmware/policy/frozen_policy.hpp"
#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

/// A frozen policy as a searcher: remembers, sees and decides with the code that flies (firmware/policy).
class Learned : public Searcher {
 public:
  /// @param policy, tables  outlive this
  /// @param domain  the area it searches in, of the policy's area size
  Learned(const policy::FrozenPolicy& policy, const policy::OceanTables& tables, policy::ActionDraw draw, const Rectangle& domain)
      : policy_(policy), tables_(tables), draw_(draw), corner_(domain.south_west) {}
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;

 private:
  const policy::FrozenPolicy& policy_;
  const policy::OceanTables& tables_;
  policy::ActionDraw draw_;
  NorthEast corner_;
  Pcg32 random_{0};
  bool is_first_ = true;
  policy::SearchMemory memory_;
};

}  // namespace earshot::baselines
