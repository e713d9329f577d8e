#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/messages/found_declaration.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/policy/found/found_rule.hpp"
#include "firmware/policy/ocean_belief/hypotheses/assumptions.hpp"
#include "firmware/policy/ocean_belief/hypotheses/retained_hypotheses.hpp"

namespace earshot::policy {

/// Judges after each measurement whether the source is found. It owns the state of the rule and the declaration by the last measurement.
class Judgement {
 public:
  /// A search begins.
  void start();
  /// Judges by where the source was at a measurement that the retained hypotheses have been weighed by.
  /// @param position  of the vehicle, from the area's south-west corner   @param index  of the measurement, counted from 0
  /// @param marginal  [north x east], memory to work in
  void judge(const Assumptions& assumed, NorthEast position, const Reception& reception, std::uint32_t index,
             const RetainedHypotheses& retained, std::span<float> marginal);
  /// Of the last measurement; nothing where the source is not found there.
  [[nodiscard]] const std::optional<messages::FoundDeclaration>& declaration() const { return declaration_; }

 private:
  FoundRule rule_;
  std::optional<messages::FoundDeclaration> declaration_;
};

}  // namespace earshot::policy
