#pragma once

#include <filesystem>

#include "sim/ocean/radial_case.hpp"

namespace earshot::ocean {

/// Whether the name is that of another propagation model's input file: NAME.env.
[[nodiscard]] bool is_radial_case_name(const std::filesystem::path& path);

/// Reads such a file by its name. Throws as acoustics_toolbox::load_env does.
[[nodiscard]] RadialCase load_radial_case(const std::filesystem::path& path);

}  // namespace earshot::ocean
