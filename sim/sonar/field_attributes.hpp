#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/netcdf/writer.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/pe/solver.hpp"
#include "sim/sonar/radial.hpp"

namespace earshot::sonar {

/// "0x" and eight digits.
[[nodiscard]] std::string crc32_text(const ocean::Environment& environment);

/// Attributes of the whole file: conventions, title, what made it.
void write_provenance(netcdf::Writer& file, const std::string& title, const ocean::Environment& environment, const std::string& history);

/// The attribute "unmeasured_water" of the whole file, where there is any.
void write_unmeasured(netcdf::Writer& file, const std::optional<ocean::UnmeasuredWater>& water);

/// The attribute "predicted_error_db" of the whole file: mean error of transmission loss, where the solver chose its grid.
void write_predicted_error(netcdf::Writer& file, const std::optional<pe::MarchGrid>& grid);

void write_scalar(netcdf::Writer& file, const std::string& name, const netcdf::Attributes& attributes, double value);
void write_scalar(netcdf::Writer& file, const std::string& name, const std::string& long_name, const std::string& units, double value);

/// Transmission loss [n_range x n_depth] or [n_bearing x n_range x n_depth] as the variable "transmission_loss", rounded to 1/256 dB: the
/// digits below are the solver's errors, and without them zlib needs half the time and half the bytes. The attribute `comment` says how
/// SNR is had from variables of the same file (write_scene).
///
///   SNR = SL - TL - N
///
/// @param loss_db      dB re 1 m, NaN where there is no water; below 16 384 dB, where 1/256 is a whole number of a float's digits
/// @param coordinates  CF: scalar variables that say where, separated by blanks; may be empty
/// Oracle: FieldFile.HoldsTheLossWithinHalfOf1To256Decibel
void write_transmission_loss(netcdf::Writer& file, const std::vector<std::string>& dimensions, const std::string& coordinates,
                             std::span<const float> loss_db);

/// Source, noise and frequency band as scalar variables.
void write_scene(netcdf::Writer& file, const ocean::Environment& environment, const ocean::Band& band);

/// The local plane as a CF grid mapping named "local_plane". @return false where the environment has no geographic origin
bool write_grid_mapping(netcdf::Writer& file, const ocean::Environment& environment);

}  // namespace earshot::sonar
