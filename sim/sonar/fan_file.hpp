#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sim/ocean/environment.hpp"
#include "sim/sonar/detection.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/horizontal_map.hpp"

namespace earshot::sonar {

/// Writes transmission loss, detection probability and detection ranges [bearing x range x depth] as NetCDF-4 (CF), and the map of
/// SNR and probability beside them if there is one. Takes its name when it is whole.
///
/// @param history  the command that made it
/// Throws netcdf::FileError; nothing is left behind then. Oracle: FanFile.*
void write_fan(const std::filesystem::path& path, const Fan& fan, const std::optional<HorizontalMap>& map,
               const ocean::Environment& environment, const ocean::Band& band, const Detector& detector, const std::string& history);

}  // namespace earshot::sonar
