#include "sim/ocean/bathymetry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

#include "sim/ocean/csv_table.hpp"

namespace earshot::ocean {
namespace {

using host::BadInput;
using host::Range;

constexpr double kDeepest_m = 12'000.0;
constexpr double kHighest_m = 10'000.0;

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::size_t index_of(const std::vector<double>& axis, double value) {
  return static_cast<std::size_t>(std::lower_bound(axis.begin(), axis.end(), value) - axis.begin());
}

/// A fill value that the file does not declare is no depth.
void require_on_earth(const netcdf::Reader& file, const std::string& variable, const Bathymetry& chart) {
  for (std::size_t i = 0; i < chart.elevation_m.size(); ++i) {
    const double x = chart.elevation_m[i];
    if (std::isnan(x) || (x >= -kDeepest_m && x <= kHighest_m)) continue;
    const std::size_t columns = chart.axes.longitude_deg.size();
    std::ostringstream text;
    text << "holds " << x << " at latitude " << chart.axes.latitude_deg[i / columns] << ", longitude "
         << chart.axes.longitude_deg[i % columns] << ", must be from " << -kDeepest_m << " to " << kHighest_m
         << " m (or the variable's _FillValue where there is none)";
    throw file.error(variable, text.str());
  }
}

}  // namespace

Meters sea_floor_depth(const Bathymetry& bathymetry, GeoPosition position) {
  const auto cell = cell_at(bathymetry.axes, position);
  double elevation_m = cell ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; cell && i < 4; ++i) {
    if (cell->weight[i] > 0.0) elevation_m += cell->weight[i] * bathymetry.elevation_m[cell->node[i]];
  }
  if (std::isfinite(elevation_m)) return Meters{-elevation_m};
  std::ostringstream text;
  text << bathymetry.file << ": no elevation at latitude " << position.latitude_deg << ", longitude " << position.longitude_deg
       << (cell ? "" : " (outside the file or the reach_km that was read)");
  throw BadInput(text.str());
}

Bathymetry read_gebco(const std::filesystem::path& path, GeoPosition centre, Meters reach) {
  const netcdf::Reader file(path);
  const GeoWindow window(file, centre, reach);
  const auto& [lat, lon] = window.dimensions();
  const std::string variable = "elevation";
  if (file.dimensions_of(variable) != std::vector<std::string>{lat, lon}) {
    throw file.error(variable, "must have the dimensions (" + lat + ", " + lon + ")");
  }
  require_units(file, variable, {"m", "meters", "meter", "metres", "metre"});
  Bathymetry chart{.file = path.string(), .axes = window.axes(), .elevation_m = window.read(file, variable, {})};
  require_on_earth(file, variable, chart);
  return chart;
}

Bathymetry read_bathymetry_csv(const std::filesystem::path& path, GeoPosition centre) {
  const CsvTable table(path);
  table.check("latitude_deg", Range::between(-90.0, 90.0));
  table.check("longitude_deg", Range::between(-180.0, 360.0));
  table.check("elevation_m", Range::between(-kDeepest_m, kHighest_m));
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
  return grid;
}

std::vector<SeaFloorStation> read_section_csv(const std::filesystem::path& path) {
  const CsvTable table(path);
  table.check("range_m", Range::between(0.0, 1e8));
  table.check("depth_m", Range::between(0.0, kDeepest_m));
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
