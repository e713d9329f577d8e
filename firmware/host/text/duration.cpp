#include "firmware/host/text/duration.hpp"

#include <cmath>

#include "firmware/host/text/numbers.hpp"

namespace earshot::host {

std::string duration(double seconds) {
  constexpr double kInSeconds = 120.0;
  if (seconds < kInSeconds) return std::to_string(std::llround(seconds)) + " s";
  const long long minutes = std::llround(seconds / 60.0);
  return minutes < 60 ? formatted("%lld min", minutes) : formatted("%lld h %02lld min", minutes / 60, minutes % 60);
}

}  // namespace earshot::host
