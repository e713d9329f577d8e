#include "sim/ocean/charts/bathymetry.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

namespace earshot::ocean {
namespace {

using host::BadInput;

/// A fill value that the file does not declare is no depth.
void require_on_earth(const netcdf::Reader& file, const std::string& variable, const Bathymetry& chart) {
  for (std::size_t i = 0; i < chart.elevation_m.size(); ++i) {
    const double x = chart.elevation_m[i];
    if (std::isnan(x) || (x >= -kDeepestSeaFloor_m && x <= kHighestLand_m)) continue;
    const std::size_t columns = chart.axes.longitude_deg.size();
    std::ostringstream text;
    text << "holds " << x << " at latitude " << chart.axes.latitude_deg[i / columns] << ", longitude "
         << chart.axes.longitude_deg[i % columns] << ", must be from " << -kDeepestSeaFloor_m << " to " << kHighestLand_m
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

}  // namespace earshot::ocean
