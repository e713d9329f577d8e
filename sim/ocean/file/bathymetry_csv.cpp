#include "sim/ocean/file/bathymetry_csv.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

#include "sim/ocean/file/csv_table.hpp"

namespace earshot::ocean {
namespace {

using host::BadInput;
using host::Range;

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t index_of(const std::vector<double>& axis, double value) {
  return static_cast<std::size_t>(std::lower_bound(axis.begin(), axis.end(), value) - axis.begin());
}

}  // namespace

Bathymetry read_bathymetry_csv(const std::filesystem::path& path, GeoPosition centre) {
  const CsvTable table(path);
  table.check("latitude_deg", Range::between(-90.0, 90.0));
  table.check("longitude_deg", Range::between(-180.0, 360.0));
  table.check("elevation_m", Range::between(-kDeepestSeaFloor_m, kHighestLand_m));
  const std::vector<double>& latitude_deg = table.column("latitude_deg");
  std::vector<double> longitude_deg = table.column("longitude_deg");
  for (double& x : longitude_deg) x = centre.longitude_deg + std::remainder(x - centre.longitude_deg, 360.0);
  Bathymetry grid{.file = path.string(),
                  .axes = {.centre_longitude_deg = centre.longitude_deg,
                           .latitude_deg = distinct(latitude_deg),
                           .longitude_deg = distinct(longitude_deg)},
                  .elevation_m = {}};
  const std::size_t columns = grid.axes.longitude_deg.size();
  const std::size_t nodes = grid.axes.latitude_deg.size() * columns;
  if (grid.axes.latitude_deg.size() < 2 || columns < 2 || nodes > 4 * table.rows()) {
    throw BadInput(path.string() + ": must be a grid of at least 2 latitudes and 2 longitudes, each with each");
  }
  grid.elevation_m.assign(nodes, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    double& node = grid.elevation_m[index_of(grid.axes.latitude_deg, latitude_deg[row]) * columns +
                                    index_of(grid.axes.longitude_deg, longitude_deg[row])];
    if (!std::isnan(node)) throw table.error(row, "longitude_deg", "this position was there before");
    node = table.column("elevation_m")[row];
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    if (!std::isnan(grid.elevation_m[i])) continue;
    std::ostringstream text;
    text << path.string() << ": gap in the grid: no line for latitude " << grid.axes.latitude_deg[i / columns] << ", longitude "
         << grid.axes.longitude_deg[i % columns];
    throw BadInput(text.str());
  }
  require_no_stray_node(grid, "elevation_m");
  return grid;
}

std::vector<SeaFloorStation> read_section_csv(const std::filesystem::path& path) {
  const CsvTable table(path);
  table.check("range_m", Range::between(0.0, 1e8));
  table.check("depth_m", Range::between(0.0, kDeepestSeaFloor_m));
  const std::vector<double>& range_m = table.column("range_m");
  const std::vector<double>& depth_m = table.column("depth_m");
  std::vector<SeaFloorStation> stations;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (row > 0 && !(range_m[row] > range_m[row - 1])) throw table.error(row, "range_m", "must be more than in the line before");
    if (depth_m[row] == 0.0 && (row == 0 || row + 1 < table.rows())) {
      throw table.error(row, "depth_m", "must be above 0 everywhere but in the last of two or more lines, which may be the shore");
    }
    stations.push_back({.range = Meters{range_m[row]}, .depth = Meters{depth_m[row]}});
  }
  return stations;
}

}  // namespace earshot::ocean
