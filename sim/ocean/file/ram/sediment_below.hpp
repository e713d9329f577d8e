#pragma once

#include <vector>

#include "sim/ocean/environment.hpp"
#include "sim/ocean/file/ram/ram_input.hpp"

namespace earshot::ocean::ram {

/// The layers below a sea floor of what a block states from the sea surface down. Where nothing changes any more, a half-space begins; at
/// `max_depth_m` at the deepest.
[[nodiscard]] std::vector<SedimentLayer> sediment_below(double sea_floor_m, const Block& block, double max_depth_m);

/// The sediment along the radial. RAM's sediment does not follow the sea floor, Earshot's does: where it changes with depth, a station
/// stands wherever the sea floor has come `step_m` deeper or shallower, or more where there would be more than 5000.
[[nodiscard]] std::vector<SedimentStation> sediment_stations(const RamInput& input, double step_m);

}  // namespace earshot::ocean::ram
