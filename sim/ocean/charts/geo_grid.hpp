#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/netcdf/reader.hpp"
#include "sim/ocean/charts/geography.hpp"

namespace earshot::ocean {

/// The nodes of a latitude-longitude grid about a centre.
struct GeoAxes {
  double centre_longitude_deg = 0.0;
  std::vector<double> latitude_deg;  ///< strictly increasing, two or more
  /// Strictly increasing, two or more, within 180 degrees of the centre: the date line does not show. All round the earth: one more beyond
  /// that on either side, so that opposite the centre no cell is missing.
  std::vector<double> longitude_deg;
};

/// The four nodes about a position, as indices into a row-major [n_latitude x n_longitude] array, with the weights of bilinear
/// interpolation in latitude and longitude; the weights add up to one.
struct GeoCell {
  std::array<std::size_t, 4> node;
  std::array<double, 4> weight;
};

/// Nothing outside the grid.
/// Oracle: GeoGrid.WeighsTheFourNodesAboutAPosition
[[nodiscard]] std::optional<GeoCell> cell_at(const GeoAxes& axes, GeoPosition position);

/// The shortest side of the cells in the middle of the grid.
[[nodiscard]] Meters spacing(const GeoAxes& axes);

/// The part of a NetCDF file's latitude-longitude grid within `reach` of a centre, one node more on every side where the file has one.
///
/// The file's axes are `lat` and `lon` (or `latitude`, `longitude`) in degrees north and east; latitude may fall, longitude may run from
/// -180 or from 0 or across the date line from 180 to -180 and, in a global file, wraps. Where a pole lies within reach, all longitudes do.
class GeoWindow {
 public:
  /// Throws netcdf::FileError when the axes are not that, or the centre lies outside them.
  /// Oracle: GeoWindow.*
  GeoWindow(const netcdf::Reader& file, GeoPosition centre, Meters reach);

  [[nodiscard]] const GeoAxes& axes() const { return axes_; }
  /// Names of the file's dimensions, latitude first.
  [[nodiscard]] const std::array<std::string, 2>& dimensions() const { return dimensions_; }

  /// The window of a variable whose last two dimensions are latitude and longitude: [leading... x n_latitude x n_longitude], all of `count`
  /// values from 0 along each leading dimension.
  [[nodiscard]] std::vector<double> read(const netcdf::Reader& file, const std::string& variable,
                                         const std::vector<std::size_t>& leading_count) const;

 private:
  void choose_rows(const std::vector<double>& latitude_deg, GeoPosition centre, double reach_deg);
  void choose_columns(const std::vector<double>& longitude_deg, GeoPosition centre, double reach_deg);
  /// Adds the last column before the first and the first after the last, if the columns go all round the earth.
  void close_circle();

  GeoAxes axes_;
  std::array<std::string, 2> dimensions_;
  std::vector<std::size_t> rows_;     ///< in the file, of each latitude
  std::vector<std::size_t> columns_;  ///< in the file, of each longitude
};

/// Throws netcdf::FileError unless the variable's units are one of `allowed`.
void require_units(const netcdf::Reader& file, const std::string& variable, const std::vector<std::string>& allowed);

}  // namespace earshot::ocean
