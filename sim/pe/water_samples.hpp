#pragma once

#include <cstddef>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/water/sound_speed.hpp"

namespace earshot::pe {

/// Sound speed at nodes 0 to `intervals`, `step` apart, as a grid of that step is to hear it.
///
/// A smooth profile: that at the node. A table, whose kinks and thin steps may fall between nodes: 1 / c^2 as the mean over the two
/// elements beside the node, weighted by the node's share, m_i, less a twelfth of m_(i+1) - 2 m_i + m_(i-1), by which the mean of a smooth
/// profile differs from its value. So a thermocline acts with its whole strength, at its place and over its width, wherever the nodes lie.
/// Oracle: WaterSamples.*, WavenumberIntegration.*
[[nodiscard]] std::vector<double> water_samples(const ocean::SoundSpeedProfile& profile, Meters step, std::size_t intervals);

}  // namespace earshot::pe
