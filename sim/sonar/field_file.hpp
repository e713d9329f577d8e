#pragma once

#include <filesystem>
#include <string>

#include "sim/ocean/environment.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar {

/// Writes a field as NetCDF-4 after the CF conventions, under a temporary name in the same folder that is renamed when the file is
/// whole. Of the levels it holds the transmission loss alone (write_transmission_loss).
///
/// @param bearing  of the radial, clockwise from north
/// @param history  the command that made it
/// Throws netcdf::FileError, which is a std::runtime_error, with the file's name and the cause; nothing is left behind then.
/// Oracle: FieldFile.*
void write_field(const std::filesystem::path& path, const SonarField& field, const ocean::Environment& environment, Radians bearing,
                 const ocean::Band& band, const std::string& history);

}  // namespace earshot::sonar
