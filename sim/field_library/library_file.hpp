#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/field_library/plan.hpp"
#include "sim/field_library/store.hpp"
#include "sim/netcdf/reader.hpp"
#include "sim/sonar/fan.hpp"

namespace earshot::field_library {

/// A finished library on the disk: its axes, read at once and judged, and its fans, read one by one.
///
/// Not for two threads at once, as netcdf::Reader.
class LibraryFile {
 public:
  /// Throws netcdf::FileError when the file is not a library.
  explicit LibraryFile(const std::filesystem::path& path);

  [[nodiscard]] std::size_t positions() const { return shape_[0]; }
  [[nodiscard]] std::size_t bearings() const { return shape_[1]; }
  [[nodiscard]] bool has_water(std::size_t position) const { return state_[position] != static_cast<double>(PositionState::kNoWater); }
  [[nodiscard]] const std::vector<double>& north_m() const { return north_m_; }  ///< [n_position], of what stands at the positions
  [[nodiscard]] const std::vector<double>& east_m() const { return east_m_; }    ///< [n_position]
  [[nodiscard]] const std::vector<double>& range_m() const { return range_m_; }  ///< evenly spaced, the first a step away
  [[nodiscard]] const std::vector<double>& depth_m() const { return depth_m_; }  ///< increasing

  // Each is read when it is asked for. Throws netcdf::FileError.
  [[nodiscard]] Meters centre_depth() const;
  [[nodiscard]] std::vector<double> frequency_hz() const;  ///< increasing
  [[nodiscard]] Decibels source_level() const;             ///< dB re 1 uPa @ 1 m
  [[nodiscard]] Decibels noise_level() const;              ///< in the detector's band, dB re 1 uPa
  [[nodiscard]] Centre centre() const;                     ///< what stands at the positions

  /// The file is not read whole before its header and axes have told that it can be kept in memory. Throws netcdf::FileError.
  /// @param positions  how many of them are to be kept
  void require_room(std::size_t positions) const;

  /// Its sea floor is empty. Throws netcdf::FileError where there is no such position, or no field of it.
  [[nodiscard]] sonar::Fan fan(std::size_t position) const;

  /// A text about the whole file, such as "environment"; nothing where it has none of this name.
  [[nodiscard]] std::optional<std::string> text(const std::string& attribute) const { return file_.text_attribute("", attribute); }

  /// An error about this file.
  [[nodiscard]] netcdf::FileError error(const std::string& variable, const std::string& what) const { return file_.error(variable, what); }

 private:
  [[nodiscard]] double values_of_fan() const;
  [[nodiscard]] std::size_t size_of(const std::string& variable) const;
  [[nodiscard]] std::vector<double> axis(const std::string& variable, std::size_t size, const host::Range& allowed) const;
  void require_increasing(const std::string& variable, const std::vector<double>& values) const;
  void require_even_ranges() const;
  void require_no_gaps(const netcdf::Block& block, const std::vector<double>& loss) const;

  netcdf::Reader file_;
  std::vector<std::size_t> shape_;
  std::vector<double> state_, north_m_, east_m_, range_m_, depth_m_;
};

}  // namespace earshot::field_library
