#include "sim/pe/absorber.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace earshot::pe {

namespace {

using Complex = std::complex<double>;

constexpr double kGrowth = 1.5;         // 12 nepers lost in a round trip, by the infinite product; 1e-4 is left with both ends cut
constexpr double kShortestPhase = 0.5;  // of a vertical wave over the first element
constexpr double kLongestPhase = 6.0;   // of the most grazing wave over the last
constexpr double kTurn = 0.03;          // radians that a wave turns by, against the grazing one, within the range: less is nothing

/// Vertical wavenumber of the most grazing wave that matters.
double most_grazing(const ocean::SedimentLayer& half_space, Hertz frequency, Meters max_range) {
  const double k = 2.0 * std::numbers::pi * frequency.value / half_space.sound_speed.value;
  const double loss_tangent = half_space.attenuation_db_per_wavelength / (40.0 * std::numbers::pi * std::numbers::log10e);
  return std::min(k, std::max(k * std::sqrt(2.0 * loss_tangent), std::sqrt(2.0 * kTurn * k / max_range.value)));
}

}  // namespace

Complex Absorber::length_m(std::size_t element) const {
  return std::polar(shortest_m * std::pow(growth, static_cast<double>(element)), 0.25 * std::numbers::pi);
}

double Absorber::reflection(Complex vertical_wavenumber_per_m) const {
  double result = 1.0;
  for (std::size_t j = 0; j < elements; ++j) {
    const Complex half = Complex(0.0, 0.5) * vertical_wavenumber_per_m * length_m(j);
    result *= std::norm((1.0 + half) / (1.0 - half));
  }
  return result;
}

double Absorber::thickness_m() const {
  return shortest_m * (std::pow(growth, static_cast<double>(elements)) - 1.0) / (growth - 1.0);
}

Absorber choose_absorber(const ocean::Section& section, Hertz frequency, Meters max_range, std::optional<double> wavelengths) {
  double slowest = section.sediment.front().layers.back().sound_speed.value;
  double fastest = slowest;
  double grazing = 1e9;
  for (const ocean::SedimentStation& station : section.sediment) {
    const ocean::SedimentLayer& half_space = station.layers.back();
    slowest = std::min(slowest, half_space.sound_speed.value);
    fastest = std::max(fastest, half_space.sound_speed.value);
    grazing = std::min(grazing, most_grazing(half_space, frequency, max_range));
  }
  Absorber absorber{.shortest_m = kShortestPhase * slowest / (2.0 * std::numbers::pi * frequency.value), .growth = kGrowth, .elements = 1};
  const auto is_enough = [&] {
    if (wavelengths) return absorber.thickness_m() >= *wavelengths * fastest / frequency.value;
    return std::abs(absorber.length_m(absorber.elements - 1)) >= kLongestPhase / grazing;
  };
  while (!is_enough()) ++absorber.elements;
  return absorber;
}

double largest_reflection(const Absorber& absorber, const ocean::Section& section, Hertz frequency, Meters max_range) {
  constexpr int kAngles = 60;
  double largest = 0.0;
  for (const ocean::SedimentStation& station : section.sediment) {
    const ocean::SedimentLayer& half_space = station.layers.back();
    const double k = 2.0 * std::numbers::pi * frequency.value / half_space.sound_speed.value;
    const double grazing = most_grazing(half_space, frequency, max_range);
    for (int i = 0; i <= kAngles; ++i)
      largest = std::max(largest, absorber.reflection(grazing * std::pow(k / grazing, static_cast<double>(i) / kAngles)));
  }
  return largest;
}

}  // namespace earshot::pe
