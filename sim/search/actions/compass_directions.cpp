#include "sim/search/actions/compass_directions.hpp"

#include <array>
#include <cassert>
#include <numbers>

#include "firmware/core/math.hpp"

namespace earshot::search {
namespace {

/// Exact where it falls on a quarter of the compass.
UnitNorthEast direction(std::size_t i, std::size_t count) {
  static constexpr std::array<UnitNorthEast, 4> kCardinals{{{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}};
  if ((4 * i) % count == 0) return kCardinals[4 * i / count];
  const double turn = static_cast<double>(i) / static_cast<double>(count);
  const SineCosine bearing = sine_cosine(Radians{2.0 * std::numbers::pi * turn});
  return {bearing.cosine, bearing.sine};
}

}  // namespace

ActionTable compass_directions(std::size_t count) {
  assert(count >= 1 && count <= config::kMaxActions);
  ActionTable table;
  for (std::size_t i = 0; i < count; ++i) {
    if (table.push_back(direction(i, count)) != Status::kOk) break;
  }
  return table;
}

}  // namespace earshot::search
