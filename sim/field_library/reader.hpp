#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/field_library/plan.hpp"
#include "sim/sonar/fan.hpp"

namespace earshot::field_library {

/// A finished library in memory. What is heard in a search is made of its fans, by search::Soundscape.
///
/// Memory: 4 bytes x positions x bearings x ranges x depths, at most 2 GiB; a larger library is refused (make one of fewer depths, or read
/// single fans with `read_library_fan`).
class FieldLibrary {
 public:
  /// Throws netcdf::FileError when the file is not a finished library or too large. Oracle: FieldLibraryInMemory.*
  explicit FieldLibrary(const std::filesystem::path& path);

  /// One for each position in the water, in the order of the plan; all have the same depths. Their sea floors are empty.
  [[nodiscard]] std::span<const sonar::Fan> fans() const { return fans_; }
  [[nodiscard]] Centre centre() const { return centre_; }  ///< what stands at the positions
  [[nodiscard]] Meters centre_depth() const { return centre_depth_; }
  /// Intensity is averaged over these; increasing, one at least.
  [[nodiscard]] std::span<const double> frequency_hz() const { return frequency_hz_; }

 private:
  std::vector<sonar::Fan> fans_;
  Centre centre_ = Centre::kSource;
  Meters centre_depth_;
  std::vector<double> frequency_hz_;
};

/// Judges by its header and its axes whether a file is a library that FieldLibrary could hold; of the fields nothing is read, however
/// large the file is.
/// Throws netcdf::FileError when it is none. Oracle: FieldLibraryHeader.*
void require_library(const std::filesystem::path& path);

/// The fan of one position of a finished library; its sea floor is empty.
/// Throws netcdf::FileError when the file is not a whole library or has no such position, or none in the water.
[[nodiscard]] sonar::Fan read_library_fan(const std::filesystem::path& path, std::size_t position);

}  // namespace earshot::field_library
