#pragma once

#include <filesystem>

#include "sim/ocean/radial_case.hpp"

namespace earshot::ocean::ram {

/// Reads a ram.in file of RAM 1.5. The receivers are those of its tl.grid: every `ndz`-th node of its depth grid from the surface at node
/// 1, and the end of every `ndr`-th of its range steps.
///
/// Throws host::BadInput "FILE:LINE: WHAT = VALUE: what is allowed" for the first thing that is wrong. Oracle: RamFile.*
[[nodiscard]] RadialCase load_ram(const std::filesystem::path& path);

}  // namespace earshot::ocean::ram
