#pragma once

#include "firmware/guidance/fallback.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "policy/baselines/searcher.hpp"

namespace earshot::baselines {

/// A frozen policy as a searcher: remembers, sees, decides and falls back with the code that flies (firmware/policy, firmware/guidance).
class Learned : public Searcher {
 public:
  /// @param policy, tables  outlive this
  /// @param domain  the area it searches in, of the policy's area size
  /// @param edge_margin  of the area that a sweep keeps out of, >= 0
  Learned(const policy::FrozenPolicy& policy, const policy::OceanTables& tables, policy::ActionDraw draw, const Rectangle& domain,
          Meters edge_margin)
      : policy_(policy), tables_(tables), draw_(draw), domain_(domain), edge_margin_(edge_margin) {}
  void begin(Pcg32 random) override;
  [[nodiscard]] std::size_t choose(const DecisionInput& input) override;
  void refine() override;
  [[nodiscard]] std::optional<bool> declares_found() const override;
  [[nodiscard]] std::optional<bool> is_mismatched() const override;

 private:
  const policy::FrozenPolicy& policy_;
  const policy::OceanTables& tables_;
  policy::ActionDraw draw_;
  Rectangle domain_;
  Meters edge_margin_;
  Pcg32 random_{0};
  bool is_first_ = true;
  policy::SearchMemory memory_;
  guidance::Fallback fallback_;
};

}  // namespace earshot::baselines
