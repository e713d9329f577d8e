#pragma once

#include <filesystem>

#include "sim/ocean/radial_case.hpp"

namespace earshot::ocean::acoustics_toolbox {

/// Reads an .env file of the Acoustics Toolbox, of BELLHOP as of KRAKEN and SCOOTER, and the .ssp and .bty beside it where it asks for
/// them.
///
/// Throws host::BadInput "FILE:LINE: WHAT = VALUE: what is allowed" for the first thing that is wrong or has no meaning here: shear, rough
/// or hard boundaries, several sources or frequencies. Source: the descriptions of the environmental, bathymetry and sound speed files that
/// come with the Acoustics Toolbox (Porter, 2023). Oracle: EnvFile.*
[[nodiscard]] RadialCase load_env(const std::filesystem::path& path);

}  // namespace earshot::ocean::acoustics_toolbox
