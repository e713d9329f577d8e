#pragma once

#include <string>

#include "sim/netcdf/writer.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/sonar/radial.hpp"

namespace earshot::sonar {

/// "0x" and eight digits.
[[nodiscard]] std::string crc32_text(const ocean::Environment& environment);

/// Attributes of the whole file: conventions, title, what made it.
void write_provenance(netcdf::Writer& file, const std::string& title, const ocean::Environment& environment, const std::string& history);

void write_scalar(netcdf::Writer& file, const std::string& name, const std::string& long_name, const std::string& units, double value);

/// Source, noise and frequency band as scalar variables.
void write_scene(netcdf::Writer& file, const ocean::Environment& environment, const Band& band);

/// The local plane as a CF grid mapping named "local_plane". @return false where the environment has no geographic origin
bool write_grid_mapping(netcdf::Writer& file, const ocean::Environment& environment);

}  // namespace earshot::sonar
