#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace earshot::host {

/// Bounds of a number, both allowed unless `lower` says that the lower one is not.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  enum class Lower : std::uint8_t { kAtLeast, kAbove } lower = Lower::kAtLeast;

  static Range at_least(double x) { return {x, std::numeric_limits<double>::infinity(), Lower::kAtLeast}; }
  static Range above(double x) { return {x, std::numeric_limits<double>::infinity(), Lower::kAbove}; }
  static Range between(double low, double high) { return {low, high, Lower::kAtLeast}; }
  static Range above_up_to(double low, double high) { return {low, high, Lower::kAbove}; }

  /// False for infinity and NaN, whatever the bounds.
  [[nodiscard]] bool allows(double x) const;
};

/// "must be a finite number above 0 and at most 12000".
[[nodiscard]] std::string to_string(const Range& range);

}  // namespace earshot::host
