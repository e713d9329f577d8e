#pragma once

#include <filesystem>

#include "sim/ocean/radial_case.hpp"

namespace earshot::ocean {

/// Whether the name is that of another propagation model's input file: NAME.env or NAME.in.
[[nodiscard]] bool is_radial_case_name(const std::filesystem::path& path);

/// Reads such a file by its name. Throws as acoustics_toolbox::load_env and ram::load_ram do.
[[nodiscard]] RadialCase load_radial_case(const std::filesystem::path& path);

}  // namespace earshot::ocean
