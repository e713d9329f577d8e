#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/sea_water.hpp"
#include "sim/ocean/sound_speed.hpp"

namespace earshot::ocean {

enum class SoundSpeedFormula : std::uint8_t { kUnesco, kMackenzie };

/// @param latitude  enters by pressure: 0.26 % of it between equator and pole, 0.2 m/s at 4000 m
[[nodiscard]] MetersPerSecond sound_speed_of(const SeaWater& water, Meters depth, Radians latitude, SoundSpeedFormula formula);

/// Reads profiles from a CSV file with the column depth_m (from 0, increasing) and either sound_speed_mps or both temperature_c and
/// salinity_psu. With a further column range_m it holds several, one after the other, range increasing; without it, one at range 0.
/// Throws host::BadInput when it is not that.
/// Oracle: WaterProfile.*
[[nodiscard]] std::vector<WaterStation> read_profile_csv(const std::filesystem::path& path, Radians latitude, SoundSpeedFormula formula);

}  // namespace earshot::ocean
