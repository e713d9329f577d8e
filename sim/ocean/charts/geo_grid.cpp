#include "sim/ocean/charts/geo_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace earshot::ocean {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMetersPerDegree = 111'195.0;  // mean radius 6371 km; only window sizes and station spacings hang on it

struct Bracket {
  std::size_t below;
  double fraction;
};

std::optional<Bracket> bracket(const std::vector<double>& axis, double at) {
  if (!(at >= axis.front() && at <= axis.back())) return std::nullopt;
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, at);
  const auto below = static_cast<std::size_t>(above - axis.begin()) - 1;
  return Bracket{below, (at - axis[below]) / (axis[below + 1] - axis[below])};
}

/// `longitude_deg` as the centre's plus at most half a turn.
double unwrapped(double longitude_deg, double centre_deg) {
  return centre_deg + std::remainder(longitude_deg - centre_deg, 360.0);
}

std::string axis_name(const netcdf::Reader& file, const std::string& brief, const std::string& full) {
  if (file.has_variable(brief)) return brief;
  if (file.has_variable(full)) return full;
  throw file.error("", "must have a variable " + brief + " or " + full);
}

bool is_monotonic(const std::vector<double>& values) {
  const auto not_rising = [](double a, double b) { return !(b > a); };
  const auto not_falling = [](double a, double b) { return !(b < a); };
  return std::adjacent_find(values.begin(), values.end(), not_rising) == values.end() ||
         std::adjacent_find(values.begin(), values.end(), not_falling) == values.end();
}

/// Longitudes as they run on across the seam at 180 or 360 degrees.
std::vector<double> continued(std::vector<double> longitude_deg) {
  for (std::size_t i = 1; i < longitude_deg.size(); ++i) longitude_deg[i] = unwrapped(longitude_deg[i], longitude_deg[i - 1]);
  return longitude_deg;
}

std::vector<double> read_axis(const netcdf::Reader& file, const std::string& name, const std::vector<std::string>& units,
                              double largest_deg) {
  if (file.shape_of(name).size() != 1) throw file.error(name, "must have one dimension");
  require_units(file, name, units);
  std::vector<double> values = file.read(name);
  if (values.size() < 2) throw file.error(name, "must have at least two values");
  for (const double x : values) {
    if (!(std::abs(x) <= largest_deg)) {
      std::ostringstream text;
      text << "holds " << x << ", must lie within " << largest_deg << " degrees of 0";
      throw file.error(name, text.str());
    }
  }
  const bool is_longitude = largest_deg > 90.0;
  if (!is_monotonic(values) && !(is_longitude && is_monotonic(continued(values))))
    throw file.error(name, "must increase or decrease throughout");
  return values;
}

}  // namespace

void require_units(const netcdf::Reader& file, const std::string& variable, const std::vector<std::string>& allowed) {
  const std::optional<std::string> units = file.text_attribute(variable, "units");
  if (units && std::find(allowed.begin(), allowed.end(), *units) != allowed.end()) return;
  throw file.error(variable, "units must be " + allowed.front() + ", " + (units ? "are " + *units : "are not given"));
}

std::optional<GeoCell> cell_at(const GeoAxes& axes, GeoPosition position) {
  const auto lat = bracket(axes.latitude_deg, position.latitude_deg);
  const auto lon = bracket(axes.longitude_deg, unwrapped(position.longitude_deg, axes.centre_longitude_deg));
  if (!lat || !lon) return std::nullopt;
  const std::size_t south_west = lat->below * axes.longitude_deg.size() + lon->below;
  const std::size_t north_west = south_west + axes.longitude_deg.size();
  const double north = lat->fraction;
  const double east = lon->fraction;
  return GeoCell{.node = {south_west, south_west + 1, north_west, north_west + 1},
                 .weight = {(1.0 - north) * (1.0 - east), (1.0 - north) * east, north * (1.0 - east), north * east}};
}

Meters spacing(const GeoAxes& axes) {
  const std::size_t i = (axes.latitude_deg.size() - 1) / 2;
  const std::size_t j = (axes.longitude_deg.size() - 1) / 2;
  const double north_deg = axes.latitude_deg[i + 1] - axes.latitude_deg[i];
  const double east_deg = (axes.longitude_deg[j + 1] - axes.longitude_deg[j]) * std::cos(axes.latitude_deg[i] * kDegree);
  return Meters{kMetersPerDegree * std::min(north_deg, std::max(east_deg, 0.01 * north_deg))};
}

GeoWindow::GeoWindow(const netcdf::Reader& file, GeoPosition centre, Meters reach) {
  dimensions_ = {axis_name(file, "lat", "latitude"), axis_name(file, "lon", "longitude")};
  axes_.centre_longitude_deg = centre.longitude_deg;
  const double reach_deg = reach.value / kMetersPerDegree;
  choose_rows(read_axis(file, dimensions_[0], {"degrees_north", "degree_north", "degrees_N", "degree_N", "degreesN"}, 90.0), centre,
              reach_deg);
  choose_columns(read_axis(file, dimensions_[1], {"degrees_east", "degree_east", "degrees_E", "degree_E", "degreesE"}, 360.0), centre,
                 reach_deg);
  if (axes_.latitude_deg.size() < 2 || axes_.longitude_deg.size() < 2 || !cell_at(axes_, centre)) {
    std::ostringstream text;
    text << "does not cover latitude " << centre.latitude_deg << ", longitude " << centre.longitude_deg;
    throw file.error("", text.str());
  }
}

void GeoWindow::choose_rows(const std::vector<double>& latitude_deg, GeoPosition centre, double reach_deg) {
  const bool falling = latitude_deg.front() > latitude_deg.back();
  const std::size_t n = latitude_deg.size();
  const auto rising = [&](std::size_t i) { return falling ? n - 1 - i : i; };
  std::size_t first = 0;
  std::size_t last = n - 1;
  while (first + 1 < n && latitude_deg[rising(first + 1)] < centre.latitude_deg - reach_deg) ++first;
  while (last > first && latitude_deg[rising(last - 1)] > centre.latitude_deg + reach_deg) --last;
  for (std::size_t i = first; i <= last; ++i) {
    rows_.push_back(rising(i));
    axes_.latitude_deg.push_back(latitude_deg[rising(i)]);
  }
}

void GeoWindow::choose_columns(const std::vector<double>& longitude_deg, GeoPosition centre, double reach_deg) {
  const double furthest_deg = std::abs(centre.latitude_deg) + reach_deg;
  const double half_width_deg = furthest_deg < 90.0 ? reach_deg / std::cos(furthest_deg * kDegree) : 180.0;  // all round the pole
  std::vector<std::pair<double, std::size_t>> all;  // (unwrapped, column), from west to east about the centre
  for (std::size_t j = 0; j < longitude_deg.size(); ++j) all.emplace_back(unwrapped(longitude_deg[j], centre.longitude_deg), j);
  std::sort(all.begin(), all.end());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool next_is_short = k + 1 < all.size() && all[k + 1].first < centre.longitude_deg - half_width_deg;
    const bool previous_is_past = k > 0 && all[k - 1].first > centre.longitude_deg + half_width_deg;
    const bool again = k > 0 && all[k].first == all[k - 1].first;  // a global file may hold both ends of the same meridian
    if (next_is_short || previous_is_past || again) continue;
    columns_.push_back(all[k].second);
    axes_.longitude_deg.push_back(all[k].first);
  }
  close_circle();
}

void GeoWindow::close_circle() {
  if (columns_.size() < 2) return;
  const double first_deg = axes_.longitude_deg.front();
  const double last_deg = axes_.longitude_deg.back();
  const double across_seam_deg = first_deg + 360.0 - last_deg;
  const double cell_deg = axes_.longitude_deg[1] - first_deg;
  if (!(across_seam_deg > 0.0 && across_seam_deg < 1.5 * cell_deg)) return;
  const std::size_t first = columns_.front();
  columns_.insert(columns_.begin(), columns_.back());
  axes_.longitude_deg.insert(axes_.longitude_deg.begin(), last_deg - 360.0);
  columns_.push_back(first);
  axes_.longitude_deg.push_back(first_deg + 360.0);
}

std::vector<double> GeoWindow::read(const netcdf::Reader& file, const std::string& variable,
                                    const std::vector<std::size_t>& leading_count) const {
  const std::size_t first_row = std::min(rows_.front(), rows_.back());
  const std::size_t rows = rows_.size();
  std::size_t planes = 1;
  for (const std::size_t count : leading_count) planes *= count;
  std::vector<double> window(planes * rows * columns_.size());
  for (std::size_t run = 0; run < columns_.size();) {
    std::size_t end = run + 1;
    while (end < columns_.size() && columns_[end] == columns_[end - 1] + 1) ++end;
    netcdf::Block block{.start = std::vector<std::size_t>(leading_count.size(), 0), .count = leading_count};
    block.start.insert(block.start.end(), {first_row, columns_[run]});
    block.count.insert(block.count.end(), {rows, end - run});
    const std::vector<double> part = file.read(variable, block);
    for (std::size_t line = 0; line < planes * rows; ++line) {
      const std::size_t row_in_part = rows_.front() <= rows_.back() ? line % rows : rows - 1 - line % rows;
      const auto from = part.begin() + static_cast<std::ptrdiff_t>((line / rows * rows + row_in_part) * (end - run));
      std::copy(from, from + static_cast<std::ptrdiff_t>(end - run),
                window.begin() + static_cast<std::ptrdiff_t>(line * columns_.size() + run));
    }
    run = end;
  }
  return window;
}

}  // namespace earshot::ocean
