#pragma once

#include <filesystem>

#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::tables {

/// Draws every table's SNR against range, and the detection threshold of 10 dB: up to 24 by name, wide where the prior is large; more of
/// them coloured by the depth of the sea floor, and by name only one that weighs as much as all others.
/// @param path  ends in .png or .svg
/// Throws as plot::draw does.
void plot_curves(const std::filesystem::path& path, const policy::OceanTables& tables);

}  // namespace earshot::tables
