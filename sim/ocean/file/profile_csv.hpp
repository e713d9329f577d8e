#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/water/sea_water.hpp"

namespace earshot::ocean {

/// Of the water of one environment: one each kilometre around a quarter of the Earth. A solver samples all of them before it begins.
inline constexpr std::size_t kMostWaterStations = 10'000;

/// Reads profiles from a CSV file with the column depth_m (from 0, increasing) and either sound_speed_mps or both temperature_c and
/// salinity_psu. With a further column range_m it holds several, one after the other, range increasing; without it, one at range 0.
/// Throws host::BadInput when it is not that.
/// Oracle: WaterProfile.*
[[nodiscard]] std::vector<WaterStation> read_profile_csv(const std::filesystem::path& path, Radians latitude, SoundSpeedFormula formula);

}  // namespace earshot::ocean
