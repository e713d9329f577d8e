#include "sim/pe/depth_operator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earshot::pe {

namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

/// k = (omega / c) (1 + i alpha / (40 pi log10 e)), alpha in dB per wavelength: Jensen et al., Eq. 1.47.
Complex wavenumber(double angular_frequency, double sound_speed_mps, double attenuation_db_per_wavelength) {
  const double loss_tangent = attenuation_db_per_wavelength / (40.0 * kPi * std::numbers::log10e);
  return angular_frequency / sound_speed_mps * Complex(1.0, loss_tangent);
}

SedimentPoint between(const SedimentPoint& a, const SedimentPoint& b, double depth_m) {
  const double share = (depth_m - a.depth_below_floor_m) / (b.depth_below_floor_m - a.depth_below_floor_m);
  const auto mix = [share](double x, double y) { return x + share * (y - x); };
  return {depth_m, mix(a.sound_speed_mps, b.sound_speed_mps), mix(a.density_g_per_cm3, b.density_g_per_cm3),
          mix(a.attenuation_db_per_wavelength, b.attenuation_db_per_wavelength)};
}

constexpr double kThinnest = 1e-6;  // of an element: thinner slices of a medium are left to their neighbours

}  // namespace

DepthOperator::DepthOperator(const Section& section, Hertz frequency, const DepthGrid& grid)
    : section_(section), angular_frequency_(2.0 * kPi * frequency.value), grid_(grid), water_potential_(grid.intervals + 1) {
  for (const WaterColumn& column : section_.water) {
    std::vector<double>& speeds = sound_speed_.emplace_back();
    for (std::size_t node = 0; node <= grid_.intervals; ++node)
      speeds.push_back(ocean::sound_speed(column.profile, Meters{static_cast<double>(node) * grid_.step_m}).value);
  }
  for (Tridiagonal* matrix : {&mass_, &g_}) {
    matrix->diagonal.assign(grid_.intervals + 1, 0.0);
    matrix->off.assign(grid_.intervals + 1, 0.0);
  }
  sediment_ = &section_.sediment_at(0.0);
  floor_depth_m_ = floor_at(0.0);
  sample_water(0.0);
  assemble(0, grid_.intervals - 1);
}

double DepthOperator::floor_at(double range_m) const {
  return std::max(section_.floor_depth_m(range_m), kThinnest * grid_.step_m);
}

std::size_t DepthOperator::element_of(double depth_m) const {
  return std::min(static_cast<std::size_t>(depth_m / grid_.step_m), grid_.intervals - 1);
}

RowRange DepthOperator::rows_changed_by(double range_m) const {
  const double floor = floor_at(range_m);
  const SedimentColumn& sediment = section_.sediment_at(range_m);
  const bool same_water = !section_.water_varies() || range_m == range_m_;
  const bool same_sediment = &sediment == sediment_;
  if (floor == floor_depth_m_ && same_water && same_sediment) return {};
  const double layers = std::max(sediment.points.back().depth_below_floor_m, sediment_->points.back().depth_below_floor_m);
  const std::size_t first = same_water ? element_of(std::min(floor, floor_depth_m_)) : 0;
  const std::size_t last = same_sediment ? element_of(std::max(floor, floor_depth_m_) + layers) : grid_.intervals - 1;
  return {std::max<std::size_t>(first, 1), std::min(last + 1, grid_.intervals - 1)};
}

void DepthOperator::move_to(double range_m) {
  const RowRange changed = rows_changed_by(range_m);
  if (section_.water_varies() && range_m != range_m_) sample_water(range_m);
  range_m_ = range_m;
  floor_depth_m_ = floor_at(range_m);
  sediment_ = &section_.sediment_at(range_m);
  if (!changed.empty()) assemble(changed.first - 1, changed.last);
}

void DepthOperator::sample_water(double range_m) {
  std::size_t here = 0;
  while (here + 1 < section_.water.size() && section_.water[here + 1].range_m <= range_m) ++here;
  const std::size_t next = std::min(here + 1, section_.water.size() - 1);
  const double share =
      next == here ? 0.0 : (range_m - section_.water[here].range_m) / (section_.water[next].range_m - section_.water[here].range_m);
  const double loss_per_m = section_.water_attenuation_db_per_km / (20.0 * std::numbers::log10e * 1000.0);
  for (std::size_t node = 0; node <= grid_.intervals; ++node) {
    const double speed = sound_speed_[here][node] + share * (sound_speed_[next][node] - sound_speed_[here][node]);
    const Complex ratio = Complex(angular_frequency_ / speed, loss_per_m) / grid_.reference_wavenumber_per_m;
    water_potential_[node] = ratio * ratio - 1.0;
  }
}

Complex DepthOperator::water_potential(double depth_m) const {
  const std::size_t node = element_of(depth_m);
  const double share = depth_m / grid_.step_m - static_cast<double>(node);
  return water_potential_[node] + share * (water_potential_[node + 1] - water_potential_[node]);
}

DepthOperator::Element DepthOperator::uniform(Complex potential_top, Complex potential_bottom, Complex length, double density,
                                              double reference_wavenumber) {
  const Complex potential = 0.5 * (potential_top + potential_bottom);
  const Complex phase = reference_wavenumber * length;
  const Complex inverse_density = (1.0 + potential * phase * phase / 12.0) / density;
  const Complex diagonal = inverse_density * length * (5.0 / 12.0);
  const Complex off = inverse_density * length / 12.0;
  return {inverse_density / length, diagonal, off, diagonal, diagonal * potential_top, off * potential, diagonal * potential_bottom};
}

/// Eliminates the node between two pieces: its pressure is what keeps the flux continuous.
DepthOperator::Element DepthOperator::joined(const Element& upper, const Element& lower) {
  const Complex sum = upper.stiffness + lower.stiffness;
  const Complex up = upper.stiffness / sum;
  const Complex down = lower.stiffness / sum;
  const Complex mass = upper.mass11 + lower.mass00;
  const Complex potential = upper.potential11 + lower.potential00;
  return {up * lower.stiffness,
          upper.mass00 + 2.0 * upper.mass01 * up + mass * up * up,
          upper.mass01 * down + lower.mass01 * up + mass * up * down,
          lower.mass11 + 2.0 * lower.mass01 * down + mass * down * down,
          upper.potential00 + 2.0 * upper.potential01 * up + potential * up * up,
          upper.potential01 * down + lower.potential01 * up + potential * up * down,
          lower.potential11 + 2.0 * lower.potential01 * down + potential * down * down};
}

DepthOperator::Element DepthOperator::water_piece(std::size_t index, double top_m, double bottom_m) const {
  const bool whole = bottom_m - top_m > (1.0 - kThinnest) * grid_.step_m;
  const Complex top = whole ? water_potential_[index] : water_potential(top_m);
  const Complex bottom = whole ? water_potential_[index + 1] : water_potential(bottom_m);
  return uniform(top, bottom, bottom_m - top_m, 1.0, grid_.reference_wavenumber_per_m);
}

/// A stretch of sediment, cut at every point of its column that lies inside. In the half-space below the layers the absorber begins at
/// `absorber_top_m`: length (1 + (1 + i) 3 t^3), t from 0 to 1.
DepthOperator::Element DepthOperator::sediment_piece(double top_m, double bottom_m) const {
  const std::vector<SedimentPoint>& points = sediment_->points;
  const auto potential = [this](const SedimentPoint& p) {
    const Complex ratio =
        wavenumber(angular_frequency_, p.sound_speed_mps, p.attenuation_db_per_wavelength) / grid_.reference_wavenumber_per_m;
    return ratio * ratio - 1.0;
  };
  Element result{};
  bool begun = false;
  const auto add = [&](const SedimentPoint& top, const SedimentPoint& bottom, Complex length) {
    const double density = 0.5 * (top.density_g_per_cm3 + bottom.density_g_per_cm3);
    const Element piece = uniform(potential(top), potential(bottom), length, density, grid_.reference_wavenumber_per_m);
    result = begun ? joined(result, piece) : piece;
    begun = true;
  };
  const double from = top_m - floor_depth_m_;
  const double to = bottom_m - floor_depth_m_;
  double reached = from;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double end = std::min(points[i + 1].depth_below_floor_m, to);
    if (end - reached <= kThinnest * grid_.step_m) continue;
    add(between(points[i], points[i + 1], reached), between(points[i], points[i + 1], end), end - reached);
    reached = end;
  }
  if (to - reached > kThinnest * grid_.step_m || !begun) {
    Complex length = to - reached;
    const double end_m = static_cast<double>(grid_.intervals) * grid_.step_m;
    const double t = (0.5 * (top_m + bottom_m) - grid_.absorber_top_m) / (end_m - grid_.absorber_top_m);
    if (t > 0.0) length *= 1.0 + Complex(3.0, 3.0) * t * t * t;
    add(points.back(), points.back(), length);
  }
  return result;
}

DepthOperator::Element DepthOperator::element(std::size_t index) const {
  const double top = static_cast<double>(index) * grid_.step_m;
  const double bottom = static_cast<double>(index + 1) * grid_.step_m;
  const double sliver = kThinnest * grid_.step_m;
  if (bottom <= floor_depth_m_ + sliver) return water_piece(index, top, bottom);
  if (top >= floor_depth_m_ - sliver) return sediment_piece(std::max(top, floor_depth_m_), bottom);
  return joined(water_piece(index, top, floor_depth_m_), sediment_piece(floor_depth_m_, bottom));
}

void DepthOperator::assemble(std::size_t first_element, std::size_t last_element) {
  const double scale = 1.0 / (grid_.reference_wavenumber_per_m * grid_.reference_wavenumber_per_m);
  Element above = first_element > 0 ? element(first_element - 1) : Element{};
  for (std::size_t i = first_element; i <= last_element + 1; ++i) {
    const Element here = i < grid_.intervals ? element(i) : Element{};
    mass_.diagonal[i] = above.mass11 + here.mass00;
    mass_.off[i] = here.mass01;
    g_.diagonal[i] = above.potential11 + here.potential00 - scale * (above.stiffness + here.stiffness);
    g_.off[i] = here.potential01 + scale * here.stiffness;
    above = here;
  }
}

}  // namespace earshot::pe
