#pragma once

#include <filesystem>

#include "firmware/host/file/output_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar::model_files {

/// RAM's own files are the same, byte for byte, and there is no room for a mark.
inline constexpr host::OutputKind kGridOutput{
    .name = "known to be Earshot's, for a tl.grid file does not name its author", .beginnings = {}, .is_recognisable = false};

/// Writes transmission loss in dB as the tl.grid file of RAM 1.5, whole or not at all: a record with the number of depths, then a record
/// for each range with the loss at each depth, in single precision. Ranges and depths themselves are not in such a file.
/// @param field  NaN stands where there is no water
/// Throws host::BadInput naming the file.
/// Source: Collins, User's Guide for RAM Versions 1.0 and 1.0p, Naval Research Laboratory; records as gfortran lays them out.
/// Oracle: GridFile.*
void write_tl_grid(const std::filesystem::path& path, const SonarField& field);

}  // namespace earshot::sonar::model_files
