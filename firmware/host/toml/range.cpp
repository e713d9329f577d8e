#include "firmware/host/toml/range.hpp"

#include <cmath>

#include "firmware/host/text/numbers.hpp"

namespace earshot::host {
namespace {

/// As a person would write it: 1000000, not 1e+06; what has more digits than one counts at a glance stays short (1e+30).
std::string written(double x) {
  constexpr double kLongest = 1e10;
  return std::trunc(x) == x && std::abs(x) < kLongest ? decimals(x, 0) : significant(x, 6);
}

}  // namespace

bool Range::allows(double x) const {
  const bool low = lower == Lower::kAbove ? x > lowest : x >= lowest;
  return std::isfinite(x) && low && x <= highest;
}

std::string to_string(const Range& range) {
  const bool low = std::isfinite(range.lowest);
  const bool high = std::isfinite(range.highest);
  std::string text = "must be a finite number";
  if (low) text += (range.lower == Range::Lower::kAbove ? " above " : " of at least ") + written(range.lowest);
  if (low && high) text += " and";
  if (high) text += " at most " + written(range.highest);
  return text;
}

}  // namespace earshot::host
