#include "firmware/host/toml/range.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace earshot::host {
namespace {

/// As a person would write it: 1000000, not 1e+06; what has more digits than one counts at a glance stays short (1e+30).
std::string written(double x) {
  constexpr double kLongest = 1e10;
  std::ostringstream text;
  if (std::trunc(x) == x && std::abs(x) < kLongest) text << std::fixed << std::setprecision(0);
  text << x;
  return text.str();
}

}  // namespace

bool Range::allows(double x) const {
  const bool low = lower == Lower::kAbove ? x > lowest : x >= lowest;
  return std::isfinite(x) && low && x <= highest;
}

std::string to_string(const Range& range) {
  std::ostringstream text;
  const bool low = std::isfinite(range.lowest);
  const bool high = std::isfinite(range.highest);
  text << "must be a finite number";
  if (low) text << (range.lower == Range::Lower::kAbove ? " above " : " of at least ") << written(range.lowest);
  if (low && high) text << " and";
  if (high) text << " at most " << written(range.highest);
  return text.str();
}

}  // namespace earshot::host
