#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "sim/field_library/plan.hpp"
#include "sim/parallel/ranks.hpp"
#include "sim/pe/options.hpp"

namespace earshot::field_library {

/// What became of the positions of a library.
struct LibrarySummary {
  std::size_t computed;       ///< in this sitting
  std::size_t found;          ///< computed in an earlier one
  std::size_t without_water;  ///< on land or too shallow: they stay empty
};

/// Computes a library and writes it as NetCDF (CDF-5, CF), position by position in the order of the plan: every position that is marked
/// done is on the disk, and an interrupted run goes on behind the last one. The bytes are the same whatever the number of interruptions,
/// threads and ranks. In an ocean that does not differ with place one march serves all radials of all positions.
///
/// Several ranks share the positions out in turn; rank 0 writes. Where it is not rank 0 the result is empty.
///
/// Memory: three fans and a grid for each thread.
/// Throws as compute_radial does, and netcdf::FileError.
/// Oracle: Library.*, FieldLibrary.*
LibrarySummary write_library(const std::filesystem::path& path, const LibraryPlan& plan, std::size_t threads, parallel::Ranks& ranks,
                             const pe::Progress& progress = {});

}  // namespace earshot::field_library
