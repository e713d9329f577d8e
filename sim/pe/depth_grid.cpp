#include "sim/pe/depth_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <variant>

#include "sim/pe/sediment_points.hpp"

namespace earshot::pe {

namespace {

void widen(SoundSpeedBounds& bounds, double sound_speed_mps) {
  bounds.lowest_mps = std::min(bounds.lowest_mps, sound_speed_mps);
  bounds.highest_mps = std::max(bounds.highest_mps, sound_speed_mps);
}

constexpr std::size_t kStepsToAbsorber = 6;  // on which a receiver on the deepest interface is interpolated
constexpr long kSide = static_cast<long>(DepthTap::kNodes) / 2;
constexpr long kLeastNodes = 3;  // of a medium: a thinner one is interpolated across, as if it had no interface

/// A row of nodes; those above the surface are mirror images.
struct Nodes {
  long first;
  long last;
  [[nodiscard]] long count() const { return last - first + 1; }
  /// As many as one side of an interface has in a tap.
  [[nodiscard]] Nodes nearest(double interface) const {
    return static_cast<double>(first) > interface ? Nodes{first, std::min(last, first + kSide - 1)}
                                                  : Nodes{std::max(first, last - kSide + 1), last};
  }
};

constexpr double kOnNode = 1e-9;
long first_node_below(double interface) {
  return static_cast<long>(std::ceil(interface - kOnNode));
}
long last_node_above(double interface) {
  return static_cast<long>(std::floor(interface + kOnNode));
}

DepthTap lagrange(const Nodes& nodes, double position) {
  const long count = std::min(kSide + 1, nodes.count());
  const long first = std::clamp(static_cast<long>(std::floor(position)) - count / 2 + 1, nodes.first, nodes.last - count + 1);
  DepthTap tap;
  for (long i = first; i < first + count; ++i) {
    double weight = 1.0;
    for (long m = first; m < first + count; ++m)
      if (m != i) weight *= (position - static_cast<double>(m)) / static_cast<double>(i - m);
    tap.add(i, weight);
  }
  return tap;
}

/// One of the polynomials through the nodes of one side and the interface.
struct Basis {
  double value;  // at a position
  double slope;  // at the interface
};

/// That of node `i`: 1 there, 0 at the others and at the interface.
Basis basis_of(const Nodes& nodes, long i, double interface, double position) {
  const double own = static_cast<double>(i) - interface;
  Basis basis{(position - interface) / own, 1.0 / own};
  for (long m = nodes.first; m <= nodes.last; ++m) {
    if (m == i) continue;
    basis.value *= (position - static_cast<double>(m)) / static_cast<double>(i - m);
    basis.slope *= (interface - static_cast<double>(m)) / static_cast<double>(i - m);
  }
  return basis;
}

/// That of the interface.
Basis basis_of_interface(const Nodes& nodes, double interface, double position) {
  Basis basis{1.0, 0.0};
  for (long m = nodes.first; m <= nodes.last; ++m) {
    basis.value *= (position - static_cast<double>(m)) / (interface - static_cast<double>(m));
    basis.slope += 1.0 / (interface - static_cast<double>(m));
  }
  return basis;
}

/// A position between the nodes of its own medium and an interface.
/// @param ratio  density of the own medium over that of the other
DepthTap across(const Nodes& own, const Nodes& other, double interface, double position, double ratio) {
  const Basis at_interface = basis_of_interface(own, interface, position);
  const double slope = at_interface.slope - ratio * basis_of_interface(other, interface, position).slope;
  DepthTap tap;
  for (long i = own.first; i <= own.last; ++i) {
    const Basis basis = basis_of(own, i, interface, position);
    tap.add(i, basis.value - at_interface.value * basis.slope / slope);
  }
  for (long i = other.first; i <= other.last; ++i)
    tap.add(i, at_interface.value * ratio * basis_of(other, i, interface, position).slope / slope);
  return tap;
}

}  // namespace

SoundSpeedBounds sound_speed_bounds(const ocean::Section& section) {
  SoundSpeedBounds bounds{1e9, 0.0};
  double deepest = 0.0;
  for (const ocean::SeaFloorStation& station : section.sea_floor) deepest = std::max(deepest, station.depth.value);
  for (const ocean::WaterStation& station : section.water) {
    constexpr int kSamples = 200;
    for (int i = 0; i <= kSamples; ++i) widen(bounds, ocean::sound_speed(station.profile, Meters{deepest * i / kSamples}).value);
    if (const auto* table = std::get_if<ocean::TabulatedProfile>(&station.profile)) {
      for (std::size_t i = 0; i < table->depth_m.size(); ++i)
        if (table->depth_m[i] <= deepest) widen(bounds, table->sound_speed_mps[i]);
    }
  }
  for (const ocean::SedimentStation& station : section.sediment)
    for (const SedimentPoint& point : sediment_points(station.layers)) widen(bounds, point.sound_speed_mps);
  return bounds;
}

DepthGrid make_depth_grid(const ocean::Section& section, Hertz frequency, Meters step, const Absorber& absorber) {
  double floor = 0.0;
  for (const ocean::SeaFloorStation& station : section.sea_floor) floor = std::max(floor, station.depth.value);
  double layers = 0.0;
  for (const ocean::SedimentStation& station : section.sediment)
    layers = std::max(layers, sediment_points(station.layers).back().depth_below_floor_m);
  const auto above_absorber = static_cast<std::size_t>(std::ceil((floor + layers) / step.value)) + kStepsToAbsorber;
  return {.step_m = step.value,
          .intervals = above_absorber + absorber.elements,
          .reference_wavenumber_per_m = 2.0 * std::numbers::pi * frequency.value / sound_speed_bounds(section).lowest_mps,
          .deepest_medium_m = floor + layers,
          .absorber = absorber};
}

void DepthTap::add(long signed_node, double weight_there) {
  const auto absolute = static_cast<std::size_t>(std::labs(signed_node));
  node[count] = absolute;
  weight[count++] = signed_node < 0 ? -weight_there : weight_there;
}

DepthTap tap_at(const DepthGrid& grid, double depth_m, std::span<const Interface> interface) {
  const double position = depth_m / grid.step_m;
  const auto position_of = [&grid](const Interface& i) { return i.depth_m / grid.step_m; };
  const auto lower = std::find_if(interface.begin(), interface.end(), [depth_m](const Interface& i) { return depth_m <= i.depth_m; });
  const bool has_upper = lower != interface.begin();
  const bool has_lower = lower != interface.end();
  const auto grid_end = static_cast<long>(grid.absorber_node());
  const Nodes all{-grid_end, grid_end};
  const Nodes own{has_upper ? first_node_below(position_of(*(lower - 1))) : all.first,
                  has_lower ? last_node_above(position_of(*lower)) : all.last};
  if (own.count() < kLeastNodes) return lagrange(all, position);
  if (position >= static_cast<double>(own.first) && position <= static_cast<double>(own.last)) return lagrange(own, position);

  const bool beside_lower = position > static_cast<double>(own.last);
  const auto beside = beside_lower ? lower : lower - 1;
  const auto beyond = beside_lower ? beside + 1 : beside;  // the next interface on the other side
  const bool ends = beside_lower ? beyond != interface.end() : beyond != interface.begin();
  const double at = position_of(*beside);
  const Nodes other = beside_lower ? Nodes{first_node_below(at), ends ? last_node_above(position_of(*beyond)) : all.last}
                                   : Nodes{ends ? first_node_below(position_of(*(beyond - 1))) : all.first, last_node_above(at)};
  if (other.count() < kLeastNodes) return lagrange(all, position);
  const double own_density = beside_lower ? beside->density_above : beside->density_below;
  const double other_density = beside_lower ? beside->density_below : beside->density_above;
  return across(own.nearest(at), other.nearest(at), at, position, own_density / other_density);
}

}  // namespace earshot::pe
