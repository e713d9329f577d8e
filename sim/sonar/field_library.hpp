#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/library_plan.hpp"

namespace earshot::sonar {

/// A finished library in memory: the SNR between any of its positions and any place around it, looked up in well under a microsecond
/// without allocating. What a search environment asks at every step.
///
/// Memory: 4 bytes x positions x bearings x ranges x depths, at most 2 GiB; a larger library is refused (make one of fewer depths, or read
/// single fans with `read_library_fan`).
class FieldLibrary {
 public:
  /// Throws netcdf::FileError when the file is not a finished library or too large. Oracle: FieldLibraryInMemory.*
  explicit FieldLibrary(const std::filesystem::path& path);

  /// One for each position in the water, in the order of the plan; all have the same depths. Their sea floors are empty.
  [[nodiscard]] std::span<const Fan> fans() const { return fans_; }
  [[nodiscard]] Centre centre() const { return centre_; }  ///< what stands at the positions
  [[nodiscard]] Meters centre_depth() const { return centre_depth_; }
  [[nodiscard]] Decibels source_level() const { return source_level_; }  ///< dB re 1 uPa @ 1 m
  [[nodiscard]] Decibels noise_level() const { return noise_level_; }    ///< in the detector's band, dB re 1 uPa

  /// The fan whose centre is nearest to `position`.
  [[nodiscard]] std::size_t nearest(NorthEast position) const;

  /// SNR between the centre of a fan and `position` at the depth of that index; interpolated as Fan::transmission_loss_at does. The loss
  /// is `kMaxTransmissionLoss` where there is no water and beyond the last range: never NaN.
  /// Oracle: FieldLibraryInMemory.GivesTheSnrOfItsFans
  [[nodiscard]] Decibels snr(std::size_t fan, NorthEast position, std::size_t depth) const;

 private:
  std::vector<Fan> fans_;
  Centre centre_ = Centre::kSource;
  Meters centre_depth_;
  Decibels source_level_;
  Decibels noise_level_;
};

/// The fan of one position of a finished library; its sea floor is empty.
/// Throws netcdf::FileError when the file is not a whole library or has no such position, or none in the water.
[[nodiscard]] Fan read_library_fan(const std::filesystem::path& path, std::size_t position);

}  // namespace earshot::sonar
