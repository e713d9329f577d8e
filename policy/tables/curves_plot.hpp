#pragma once

#include <filesystem>

#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::tables {

/// Draws every table's SNR against range, wide where its prior is large, and the detection threshold of 10 dB.
/// @param path  ends in .png or .svg
/// Throws as plot::draw does.
void plot_curves(const std::filesystem::path& path, const policy::OceanTables& tables);

}  // namespace earshot::tables
