#include "sim/search/actions/compass_directions.hpp"

#include <array>
#include <cassert>
#include <numbers>

#include "firmware/core/math.hpp"

namespace earshot::search {
namespace {

/// Which quarter of the compass a direction falls on exactly, 0 north, 1 east; 4 when on none.
std::size_t cardinal(std::size_t i, std::size_t count) {
  return (4 * i) % count == 0 ? 4 * i / count : 4;
}

}  // namespace

ActionTable compass_directions(std::size_t count) {
  static constexpr std::array<UnitNorthEast, 4> kCardinals{{{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}};
  assert(count >= 1 && count <= config::kMaxActions);
  ActionTable table;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = static_cast<double>(i) / static_cast<double>(count);
    const SineCosine bearing = sine_cosine(Radians{2.0 * std::numbers::pi * turn});
    const std::size_t quarter = cardinal(i, count);
    const UnitNorthEast direction = quarter < 4 ? kCardinals[quarter] : UnitNorthEast{bearing.cosine, bearing.sine};
    if (table.push_back(direction) != Status::kOk) break;
  }
  return table;
}

}  // namespace earshot::search
