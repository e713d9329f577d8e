#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "firmware/core/units.hpp"

namespace earshot::ocean {

/// The two stations about a range, the same one twice beyond the first and the last.
struct Between {
  std::size_t below;
  std::size_t above;
  double fraction;  ///< of the way from `below` to `above`
};

/// @param stations  at least one, range strictly increasing
template <class Station>
[[nodiscard]] Between stations_about(const std::vector<Station>& stations, Meters range) {
  assert(!stations.empty());
  const auto after = std::upper_bound(stations.begin(), stations.end(), range, [](Meters r, const Station& s) { return r < s.range; });
  const auto above = static_cast<std::size_t>(after - stations.begin());
  if (above == 0) return {0, 0, 0.0};
  if (above == stations.size()) return {above - 1, above - 1, 0.0};
  return {above - 1, above, (range - stations[above - 1].range) / (stations[above].range - stations[above - 1].range)};
}

/// Linear from a to b.
template <class Unit>
[[nodiscard]] Quantity<Unit> mix(Quantity<Unit> a, Quantity<Unit> b, double fraction) {
  return Quantity<Unit>{std::lerp(a.value, b.value, fraction)};
}

}  // namespace earshot::ocean
