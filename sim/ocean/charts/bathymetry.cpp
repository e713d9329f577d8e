#include "sim/ocean/charts/bathymetry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <sstream>
#include <vector>

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

/// Whether a value is what programs write where they have none (9999, -9999, 32767, -32768, ...), and could be an elevation.
bool is_usual_fill(double x) {
  const double size = std::abs(x);
  return size == 9999.0 || size == 999.0;
}

/// Steeper than two in one over a whole cell is no slope that a chart shows.
constexpr double kRoughness_m = 200.0;
constexpr double kSteepest = 2.0;

/// Whether a node is so far from all about it that no sea floor leads there; a usual fill value must be near a neighbour of another value.
bool is_stray(const Bathymetry& chart, std::size_t row, std::size_t column) {
  constexpr double kNearFill_m = 1000.0;
  const std::size_t columns = chart.axes.longitude_deg.size();
  const double here = chart.elevation_m[row * columns + column];
  const double slope_m = kRoughness_m + kSteepest * spacing(chart.axes).value;
  const double near_m = is_usual_fill(here) ? std::min(kNearFill_m, slope_m) : slope_m;
  bool has_neighbour = false;
  for (std::size_t i = row > 0 ? row - 1 : 0; i <= std::min(row + 1, chart.axes.latitude_deg.size() - 1); ++i) {
    for (std::size_t j = column > 0 ? column - 1 : 0; j <= std::min(column + 1, columns - 1); ++j) {
      const double there = chart.elevation_m[i * columns + j];
      if (std::isnan(there) || (i == row && j == column)) continue;
      has_neighbour = true;
      if (std::abs(there - here) <= near_m && !(there == here && is_usual_fill(here))) return false;
    }
  }
  return has_neighbour || is_usual_fill(here);
}

/// Nodes of one value that hang together, fewer than the others, and from which no sea floor leads to any of them: a hole in the survey
/// that somebody filled.
class FilledHoles {
 public:
  explicit FilledHoles(const Bathymetry& chart)
      : chart_(chart),
        columns_(chart.axes.longitude_deg.size()),
        farthest_m_(std::min(kFarthest_m, kRoughness_m + kSteepest * spacing(chart.axes).value)),
        was_seen_(chart.elevation_m.size()) {}

  /// Whether `node` is the first of such nodes to be asked for.
  bool begins_at(std::size_t node) {
    if (was_seen_[node]) return false;
    std::vector<std::size_t> next{node};
    std::size_t nodes = 0;
    bool has_neighbour = false;
    bool is_reached = false;
    was_seen_[node] = true;
    for (; !next.empty(); ++nodes) {
      const std::size_t here = next.back();
      next.pop_back();
      for_each_neighbour(here, [&](std::size_t there) {
        const double step_m = std::abs(chart_.elevation_m[there] - chart_.elevation_m[here]);
        if (std::isnan(step_m)) return;
        if (step_m > 0.0) {
          has_neighbour = true;
          is_reached = is_reached || step_m <= farthest_m_;
        } else if (!was_seen_[there]) {
          was_seen_[there] = true;
          next.push_back(there);
        }
      });
    }
    return nodes > 1 && nodes < chart_.elevation_m.size() / 2 && has_neighbour && !is_reached;
  }

 private:
  /// In a coarse chart, too: two nodes of the very same depth with nothing but cliffs of this height about them are no sea floor.
  static constexpr double kFarthest_m = 5000.0;

  void for_each_neighbour(std::size_t node, const std::function<void(std::size_t)>& visit) const {
    const std::size_t row = node / columns_;
    const std::size_t column = node % columns_;
    for (std::size_t i = row > 0 ? row - 1 : 0; i <= std::min(row + 1, chart_.axes.latitude_deg.size() - 1); ++i) {
      for (std::size_t j = column > 0 ? column - 1 : 0; j <= std::min(column + 1, columns_ - 1); ++j) visit(i * columns_ + j);
    }
  }

  const Bathymetry& chart_;
  std::size_t columns_;
  double farthest_m_;
  std::vector<bool> was_seen_;
};

}  // namespace

void require_no_stray_node(const Bathymetry& chart, const std::string& variable) {
  const std::size_t columns = chart.axes.longitude_deg.size();
  FilledHoles holes(chart);
  for (std::size_t i = 0; i < chart.elevation_m.size(); ++i) {
    if (std::isnan(chart.elevation_m[i]) || (!is_stray(chart, i / columns, i % columns) && !holes.begins_at(i))) continue;
    std::ostringstream text;
    text << chart.file << ": " << variable << ": holds " << chart.elevation_m[i] << " at latitude " << chart.axes.latitude_deg[i / columns]
         << ", longitude " << chart.axes.longitude_deg[i % columns]
         << ", which cannot be beside its neighbours: where there is no elevation, the file must mark it (_FillValue, missing_value, "
            "valid_range)";
    throw BadInput(text.str());
  }
}

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
  require_no_stray_node(chart, variable);
  return chart;
}

}  // namespace earshot::ocean
