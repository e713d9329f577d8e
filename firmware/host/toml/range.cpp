#include "firmware/host/toml/range.hpp"

#include <cmath>
#include <sstream>

namespace earshot::host {

bool Range::allows(double x) const {
  const bool low = lower == Lower::kAbove ? x > lowest : x >= lowest;
  return std::isfinite(x) && low && x <= highest;
}

std::string to_string(const Range& range) {
  std::ostringstream text;
  const bool low = std::isfinite(range.lowest);
  const bool high = std::isfinite(range.highest);
  text << "must be a finite number";
  if (low) text << (range.lower == Range::Lower::kAbove ? " above " : " of at least ") << range.lowest;
  if (low && high) text << " and";
  if (high) text << " at most " << range.highest;
  return text.str();
}

}  // namespace earshot::host
