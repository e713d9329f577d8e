#include "sim/ocean/water/sound_speed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace earshot::ocean {
namespace {

MetersPerSecond at_depth(const MunkProfile& munk, Meters depth) {
  const double eta = 2.0 * (depth - munk.axis_depth) / munk.scale;
  return munk.axis_sound_speed * (1.0 + munk.perturbation * (eta + std::exp(-eta) - 1.0));
}

MetersPerSecond at_depth(const TabulatedProfile& table, Meters depth) {
  const auto above = std::upper_bound(table.depth_m.begin(), table.depth_m.end(), depth.value);
  if (above == table.depth_m.begin()) return MetersPerSecond{table.sound_speed_mps.front()};
  if (above == table.depth_m.end()) return MetersPerSecond{table.sound_speed_mps.back()};
  const auto i = static_cast<std::size_t>(above - table.depth_m.begin());
  const double fraction = (depth.value - table.depth_m[i - 1]) / (table.depth_m[i] - table.depth_m[i - 1]);
  return MetersPerSecond{std::lerp(table.sound_speed_mps[i - 1], table.sound_speed_mps[i], fraction)};
}

}  // namespace

MetersPerSecond sound_speed(const SoundSpeedProfile& profile, Meters depth) {
  return std::visit([depth](const auto& kind) { return at_depth(kind, depth); }, profile);
}

}  // namespace earshot::ocean
