#include "tests/oracles/wavenumber/wavenumber.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace earshot::oracle {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;
constexpr Complex kI{0.0, 1.0};

/// J0 by its power series, where the terms do not yet cancel to nothing, and else by Hankel's expansion of both its waves.
Complex bessel_j0(Complex z) {
  if (std::abs(z) < 14.0) {
    const Complex quarter = -0.25 * z * z;
    Complex term = 1.0;
    Complex sum = 1.0;
    for (int m = 1; m < 60; ++m) sum += term *= quarter / static_cast<double>(m * m);
    return sum;
  }
  Complex p = 1.0;
  Complex q = 0.0;
  Complex term = 1.0;
  const Complex inverse = -0.125 / z;
  for (int m = 1; m <= 12 && std::norm(term) > 1e-26; ++m) {
    term *= inverse * (static_cast<double>((2 * m - 1) * (2 * m - 1)) / m);
    const double sign = m / 2 % 2 == 0 ? 1.0 : -1.0;
    (m % 2 == 0 ? p : q) += sign * term;
  }
  const Complex outward = std::exp(kI * (z - 0.25 * kPi));
  const Complex inward = 1.0 / outward;
  return std::sqrt(2.0 / (kPi * z)) * 0.5 * ((p + kI * q) * outward + (p - kI * q) * inward);
}

/// A layer at one horizontal wavenumber.
struct Slab {
  Complex impedance;  // i gamma / rho
  Complex way;        // exp(i gamma h)
};

/// The layers, cut at the source and at the receiver.
struct Stack {
  std::vector<Layer> layers;
  std::size_t above_source = 0;  // number of layers
  std::size_t above_receiver = 0;
};

/// @return the number of layers above the depth
std::size_t cut_at(std::vector<Layer>& layers, double depth_m) {
  double top_m = 0.0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (depth_m - top_m < 1e-9) return i;
    if (i + 1 == layers.size() || depth_m < top_m + layers[i].thickness_m - 1e-9) {
      Layer upper = layers[i];
      upper.thickness_m = depth_m - top_m;
      layers[i].thickness_m -= upper.thickness_m;
      layers.insert(layers.begin() + static_cast<std::ptrdiff_t>(i), upper);
      return i + 1;
    }
    top_m += layers[i].thickness_m;
  }
  return layers.size();
}

Stack stack_of(const LayeredOcean& ocean) {
  if (!(ocean.source_depth_m > 0.0 && ocean.receiver_depth_m > 0.0))
    throw std::invalid_argument("source and receiver lie below the surface");
  Stack stack{.layers = ocean.layers};
  (void)cut_at(stack.layers, std::min(ocean.source_depth_m, ocean.receiver_depth_m));
  (void)cut_at(stack.layers, std::max(ocean.source_depth_m, ocean.receiver_depth_m));
  stack.above_source = cut_at(stack.layers, ocean.source_depth_m);
  stack.above_receiver = cut_at(stack.layers, ocean.receiver_depth_m);
  return stack;
}

Complex wavenumber(const Layer& layer, double frequency_hz) {
  return 2.0 * kPi * frequency_hz / layer.sound_speed_mps *
         (1.0 + kI * layer.attenuation_db_per_wavelength / (40.0 * kPi * std::numbers::log10e));
}

/// g at the receiver; a layer's waves are written from its two ends, so that nothing grows.
Complex greens_function(const Stack& stack, double frequency_hz, Complex k) {
  const std::size_t n = stack.layers.size();
  std::vector<Slab> slab;
  for (const Layer& layer : stack.layers) {
    const Complex own = wavenumber(layer, frequency_hz);
    const Complex gamma = std::sqrt((own - k) * (own + k));  // Im >= 0: below the path no sheet is left
    slab.push_back({kI * gamma / layer.density, std::exp(kI * gamma * layer.thickness_m)});
  }
  Complex from_below = slab[n - 1].impedance;  // p' / (rho p)
  Complex transfer = 1.0;                      // pressure at the receiver over that at the source
  for (std::size_t i = n - 1; i-- > stack.above_source;) {
    const Complex reflection = (slab[i].impedance - from_below) / (slab[i].impedance + from_below);
    const Complex there = reflection * slab[i].way * slab[i].way;
    from_below = slab[i].impedance * (1.0 - there) / (1.0 + there);
    if (i < stack.above_receiver) transfer *= (1.0 + reflection) * slab[i].way / (1.0 + there);
  }
  Complex reflection = -1.0;  // of the surface, seen from the layer below
  Complex from_above = 0.0;
  for (std::size_t i = 0; i < stack.above_source; ++i) {
    if (i > 0) reflection = (slab[i].impedance + from_above) / (slab[i].impedance - from_above);
    const Complex there = reflection * slab[i].way * slab[i].way;
    from_above = -slab[i].impedance * (1.0 - there) / (1.0 + there);
    if (i >= stack.above_receiver) transfer *= (1.0 + reflection) * slab[i].way / (1.0 + there);
  }
  const double source_density = stack.layers[stack.above_source - 1].density;  // on an interface: of what lies above
  return -2.0 / source_density / (from_below - from_above) * transfer;
}

struct Node {
  double x;
  double weight;
};
constexpr std::array<Node, 8> kGauss{{{-0.9602898564975363, 0.1012285362903763},
                                      {-0.7966664774136267, 0.2223810344533745},
                                      {-0.5255324099163290, 0.3137066458778873},
                                      {-0.1834346424956498, 0.3626837833783620},
                                      {0.1834346424956498, 0.3626837833783620},
                                      {0.5255324099163290, 0.3137066458778873},
                                      {0.7966664774136267, 0.2223810344533745},
                                      {0.9602898564975363, 0.1012285362903763}}};

}  // namespace

std::vector<Layer> gradient(double thickness_m, double top_mps, double base_mps, int slices) {
  std::vector<Layer> layers;
  for (int i = 0; i < slices; ++i)
    layers.push_back(
        {.thickness_m = thickness_m / slices, .sound_speed_mps = top_mps + (base_mps - top_mps) * (i + 0.5) / slices, .density = 1.0});
  return layers;
}

std::vector<Complex> pressure(const LayeredOcean& ocean, std::span<const double> range_m) {
  const Stack stack = stack_of(ocean);
  double largest = 0.0;
  for (const Layer& layer : ocean.layers) largest = std::max(largest, wavenumber(layer, ocean.frequency_hz).real());
  const double furthest_m = *std::max_element(range_m.begin(), range_m.end());
  const double depth_of_path = 3.0 / furthest_m;  // J0 grows by exp(3) on it
  // Evanescent waves are let go smoothly: an edge would ring, at exp(-(width r)^2 / 4), at ranges where no such wave is left.
  const double half_way = 3.0 * largest;
  const double width = 0.45 * largest;
  const double end = half_way + 4.0 * width;
  const auto panels = static_cast<std::size_t>(std::ceil(end * furthest_m / (2.0 * kPi)));
  std::vector<Complex> result(range_m.size());
  for (std::size_t panel = 0; panel < panels; ++panel) {
    for (const Node& node : kGauss) {
      const double t = end * (static_cast<double>(panel) + 0.5 + 0.5 * node.x) / static_cast<double>(panels);
      const double decay = std::exp(-t / depth_of_path);
      const Complex k = t - kI * depth_of_path * (1.0 - decay);
      const Complex dk = (1.0 - kI * decay) * (0.5 * node.weight * end / static_cast<double>(panels));
      const double taper = 0.5 * std::erfc((t - half_way) / width);
      const Complex g = taper * greens_function(stack, ocean.frequency_hz, k) * k * dk;
      for (std::size_t i = 0; i < range_m.size(); ++i) result[i] += g * bessel_j0(k * range_m[i]);
    }
  }
  return result;
}

}  // namespace earshot::oracle
