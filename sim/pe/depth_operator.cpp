#include "sim/pe/depth_operator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/pe/water_samples.hpp"

namespace earshot::pe {

namespace {

using Complex = std::complex<double>;

/// k = (omega / c) (1 + i alpha / (40 pi log10 e)), alpha in dB per wavelength: Jensen et al., Eq. 1.47.
Complex wavenumber(double angular_frequency, double sound_speed_mps, double attenuation_db_per_wavelength) {
  const double loss_tangent = attenuation_db_per_wavelength / (40.0 * std::numbers::pi * std::numbers::log10e);
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

DepthOperator::DepthOperator(const ocean::Section& section, Hertz frequency, const DepthGrid& grid)
    : section_(section), angular_frequency_(2.0 * std::numbers::pi * frequency.value), grid_(grid), water_potential_(grid.intervals + 1) {
  for (const ocean::WaterStation& station : section_.water)
    sound_speed_.push_back(water_samples(station.profile, Meters{grid_.step_m}, grid_.intervals));
  for (Tridiagonal* matrix : {&mass_, &g_}) {
    matrix->diagonal.assign(grid_.intervals + 1, 0.0);
    matrix->off.assign(grid_.intervals + 1, 0.0);
  }
  for (const ocean::SedimentStation& station : section_.sediment) sediment_of_.push_back(sediment_points(station.layers));
  sediment_ = &sediment_at(0.0);
  floor_depth_m_ = floor_at(0.0);
  for (const std::vector<SedimentPoint>& points : sediment_of_) interfaces_.reserve(std::max(interfaces_.capacity(), points.size()));
  find_interfaces();
  sample_water(0.0);
  assemble(0, grid_.intervals - 1);
}

void DepthOperator::find_interfaces() {
  const std::vector<SedimentPoint>& points = *sediment_;
  interfaces_.assign(1, {floor_depth_m_, 1.0, points.front().density_g_per_cm3});
  for (std::size_t i = 1; i < points.size(); ++i) {
    const SedimentPoint& above = points[i - 1];
    const SedimentPoint& below = points[i];
    if (above.depth_below_floor_m == below.depth_below_floor_m && above.density_g_per_cm3 != below.density_g_per_cm3)
      interfaces_.push_back({floor_depth_m_ + below.depth_below_floor_m, above.density_g_per_cm3, below.density_g_per_cm3});
  }
}

double DepthOperator::floor_at(double range_m) const {
  return std::max(ocean::sea_floor_depth(section_, Meters{range_m}).value, kThinnest * grid_.step_m);
}

const std::vector<SedimentPoint>& DepthOperator::sediment_at(double range_m) const {
  return sediment_of_[static_cast<std::size_t>(&ocean::sediment_at(section_, Meters{range_m}) - section_.sediment.data())];
}

std::size_t DepthOperator::element_of(double depth_m) const {
  return std::min(static_cast<std::size_t>(depth_m / grid_.step_m), grid_.intervals - 1);
}

RowRange DepthOperator::rows_changed_by(double range_m) const {
  const double floor = floor_at(range_m);
  const std::vector<SedimentPoint>& sediment = sediment_at(range_m);
  const bool same_water = !water_varies() || range_m == range_m_;
  const bool same_sediment = &sediment == sediment_;
  if (floor == floor_depth_m_ && same_water && same_sediment) return {};
  const double layers = std::max(sediment.back().depth_below_floor_m, sediment_->back().depth_below_floor_m);
  const std::size_t first = same_water ? element_of(std::min(floor, floor_depth_m_)) : 0;
  const std::size_t last = same_sediment ? element_of(std::max(floor, floor_depth_m_) + layers) : grid_.intervals - 1;
  return {std::max<std::size_t>(first, 1), std::min(last + 1, grid_.intervals - 1)};
}

void DepthOperator::move_to(double range_m) {
  const RowRange changed = rows_changed_by(range_m);
  if (water_varies() && range_m != range_m_) sample_water(range_m);
  range_m_ = range_m;
  floor_depth_m_ = floor_at(range_m);
  sediment_ = &sediment_at(range_m);
  find_interfaces();
  if (!changed.empty()) assemble(changed.first - 1, changed.last);
}

void DepthOperator::sample_water(double range_m) {
  std::size_t here = 0;
  while (here + 1 < section_.water.size() && section_.water[here + 1].range.value <= range_m) ++here;
  const std::size_t next = std::min(here + 1, section_.water.size() - 1);
  const double share =
      next == here ? 0.0
                   : (range_m - section_.water[here].range.value) / (section_.water[next].range.value - section_.water[here].range.value);
  const double loss_per_m = section_.absorption_db_per_km / (20.0 * std::numbers::log10e * 1000.0);
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

/// Numerov's, of a whole element.
DepthOperator::Element DepthOperator::uniform(const Slice& slice) const {
  const Complex potential = 0.5 * (slice.potential_top + slice.potential_bottom);
  const double phase = grid_.reference_wavenumber_per_m * slice.length_m;
  const Complex inverse_density = (1.0 + potential * phase * phase / 12.0) / slice.density;
  const Complex diagonal = inverse_density * slice.length_m * (5.0 / 12.0);
  const Complex off = inverse_density * slice.length_m / 12.0;
  return {inverse_density / slice.length_m, diagonal, off, diagonal, diagonal * slice.potential_top, off * potential,
          diagonal * slice.potential_bottom};
}

/// Pressure linear over a part of an element: exact to first order in k^2.
DepthOperator::Element DepthOperator::galerkin(const Slice& slice) {
  const double share = slice.length_m / slice.density / 12.0;
  const Complex top = slice.potential_top;
  const Complex bottom = slice.potential_bottom;
  return {1.0 / (slice.density * slice.length_m),
          4.0 * share,
          2.0 * share,
          4.0 * share,
          share * (3.0 * top + bottom),
          share * (top + bottom),
          share * (top + 3.0 * bottom)};
}

/// Eliminates the node between two parts: its pressure is what keeps the flux continuous. Exact to first order in k^2 if they are.
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

/// The factor 1 + (k0 h)^2 X / 12 that whole elements have, to first order in k^2.
DepthOperator::Element DepthOperator::with_numerov_mass(Element element) const {
  const Complex more = element.stiffness * (grid_.step_m * grid_.step_m / 12.0);
  element.mass00 += more;
  element.mass01 -= more;
  element.mass11 += more;
  return element;
}

Complex DepthOperator::potential_of(const SedimentPoint& p) const {
  const Complex ratio =
      wavenumber(angular_frequency_, p.sound_speed_mps, p.attenuation_db_per_wavelength) / grid_.reference_wavenumber_per_m;
  return ratio * ratio - 1.0;
}

DepthOperator::Element DepthOperator::absorber_element(std::size_t index) const {
  const SedimentPoint& half_space = sediment_->back();
  const Complex potential = potential_of(half_space);
  const double phase = grid_.reference_wavenumber_per_m * grid_.step_m;
  const Complex inverse_density = (1.0 + potential * phase * phase / 12.0) / half_space.density_g_per_cm3;
  const Complex length = grid_.absorber.length_m(index);
  const Complex half = 0.25 * length * inverse_density;
  const Complex stiff = grid_.step_m * grid_.step_m / (6.0 * length) * inverse_density;
  return {inverse_density / length,  half + stiff, half - stiff, half + stiff, (half + stiff) * potential, (half - stiff) * potential,
          (half + stiff) * potential};
}

/// From the top down: the water, then the sediment, cut at every point of its column that lies inside.
template <class Visitor>
void DepthOperator::visit_slices(double top_m, double bottom_m, const Visitor& visit) const {
  const double thinnest = kThinnest * grid_.step_m;
  if (floor_depth_m_ - top_m > thinnest) {
    const double end = bottom_m - floor_depth_m_ > thinnest ? floor_depth_m_ : bottom_m;
    visit(Slice{water_potential(top_m), water_potential(end), end - top_m, 1.0});
  }
  const std::vector<SedimentPoint>& points = *sediment_;
  double reached = std::max(0.0, top_m - floor_depth_m_);
  const double to = bottom_m - floor_depth_m_;
  const auto visit_to = [&](const SedimentPoint& top, const SedimentPoint& bottom) {
    visit(Slice{potential_of(top), potential_of(bottom), bottom.depth_below_floor_m - top.depth_below_floor_m,
                0.5 * (top.density_g_per_cm3 + bottom.density_g_per_cm3)});
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double end = std::min(points[i + 1].depth_below_floor_m, to);
    if (end - reached <= thinnest) continue;
    visit_to(between(points[i], points[i + 1], reached), between(points[i], points[i + 1], end));
    reached = end;
  }
  SedimentPoint top = points.back();
  SedimentPoint bottom = points.back();
  top.depth_below_floor_m = reached;
  bottom.depth_below_floor_m = to;
  if (to - reached > thinnest) visit_to(top, bottom);
}

DepthOperator::Element DepthOperator::element(std::size_t index) const {
  if (index >= grid_.absorber_node()) return absorber_element(index - grid_.absorber_node());
  Slice first{};
  Element result{};
  std::size_t slices = 0;
  visit_slices(static_cast<double>(index) * grid_.step_m, static_cast<double>(index + 1) * grid_.step_m, [&](const Slice& slice) {
    if (slices == 0) first = slice;
    result = slices == 0 ? galerkin(slice) : joined(result, galerkin(slice));
    ++slices;
  });
  return slices == 1 ? uniform(first) : with_numerov_mass(result);
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
