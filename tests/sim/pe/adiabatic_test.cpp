// The solver where water, or sediment under a flat floor, changes slowly with range: each normal mode then keeps its energy and follows the
// wavenumber of the place (adiabatic approximation), which the dispersion relation of a Pekeris waveguide gives in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "sim/pe/solver.hpp"
#include "tests/sim/pe/short_section.hpp"

namespace earshot::pe {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
constexpr Complex kI{0.0, 1.0};

constexpr double kFrequency_hz = 18.0;
constexpr double kDepth_m = 200.0;
constexpr double kSource_m = 60.0;
constexpr double kReceiver_m = 140.0;
constexpr double kRange_m = 30'000.0;
constexpr double kStep_m = 50.0;
constexpr double kDensity = 1.5;  ///< of the sediment, g/cm3

/// What lies under one range: uniform water over a uniform half-space.
struct Place {
  double water_mps;
  double sediment_mps;
  double attenuation_db_per_wavelength;
};

struct Mode {
  Complex range_wavenumber;
  Complex depth_wavenumber;
  Complex decay;  ///< below the floor

  /// sin(kz z), such that the integral of psi^2 / density over all depths is 1.
  [[nodiscard]] Complex psi(double depth_m) const {
    const Complex sine = std::sin(depth_wavenumber * kDepth_m);
    const Complex water = kDepth_m - std::sin(2.0 * depth_wavenumber * kDepth_m) / (2.0 * depth_wavenumber);
    return std::sqrt(2.0 / (water + sine * sine / (kDensity * decay))) * std::sin(depth_wavenumber * depth_m);
  }
};

/// Mode `number` from 0, by Newton's method on kz D + atan(density kz / decay) = (number + 1) pi, the phase that fits between the surface,
/// which holds no pressure, and the floor.
/// Source: Jensen, Kuperman, Porter, Schmidt, Computational Ocean Acoustics (2011), Secs. 2.4.5 and 5.9.
Mode mode_at(const Place& place, int number) {
  const double omega = 2.0 * pi * kFrequency_hz;
  const double loss = place.attenuation_db_per_wavelength / (40.0 * pi * std::log10(std::numbers::e));
  const Complex water = omega / place.water_mps;
  const Complex sediment = omega / place.sediment_mps * (1.0 + kI * loss);
  const auto decay = [&](Complex kz) { return std::sqrt(water * water - kz * kz - sediment * sediment); };
  const auto misfit = [&](Complex kz) { return kz * kDepth_m + std::atan(kDensity * kz / decay(kz)) - (number + 1) * pi; };
  Complex kz = (number + 0.75) * pi / kDepth_m;
  for (int i = 0; i < 50; ++i) {
    const double small = 1e-7;
    kz -= misfit(kz) * small / (misfit(kz + small) - misfit(kz));
  }
  EXPECT_LT(std::abs(misfit(kz)), 1e-9);
  return {.range_wavenumber = std::sqrt(water * water - kz * kz), .depth_wavenumber = kz, .decay = decay(kz)};
}

/// Modes that are trapped at every range, as far as `kRange_m`; row i at (i + 1) kStep_m, without a common phase.
std::vector<Complex> adiabatic_pressure(const std::function<Place(double range_m)>& place_at, int modes) {
  std::vector<Complex> pressure(static_cast<std::size_t>(kRange_m / kStep_m));
  for (int number = 0; number < modes; ++number) {
    const Complex at_source = mode_at(place_at(0.0), number).psi(kSource_m);
    Complex phase = 0.0;
    for (std::size_t row = 0; row < pressure.size(); ++row) {
      const double range_m = static_cast<double>(row + 1) * kStep_m;
      phase += mode_at(place_at(range_m - 0.5 * kStep_m), number).range_wavenumber * kStep_m;
      const Mode mode = mode_at(place_at(range_m), number);
      pressure[row] +=
          std::sqrt(2.0 * pi / range_m) * at_source * mode.psi(kReceiver_m) * std::exp(kI * phase) / std::sqrt(mode.range_wavenumber);
    }
  }
  return pressure;
}

/// Mean difference of the magnitudes over the mean magnitude, beyond 8 km, where no mode but the trapped ones is left.
double difference(const ocean::Section& section, const std::vector<Complex>& expected) {
  const Field field = solve(section, {Hertz{kFrequency_hz}, Meters{kSource_m}}, {.output_step = Meters{kStep_m}},
                            std::vector<double>{kReceiver_m}, Meters{kRange_m});
  double off = 0.0;
  double all = 0.0;
  for (std::size_t row = 160; row < expected.size(); ++row) {
    off += std::abs(std::abs(field.pressure(static_cast<Eigen::Index>(row), 0)) - std::abs(expected[row]));
    all += std::abs(expected[row]);
  }
  return off / all;
}

tests::ShortSection section_of(const std::function<Place(double)>& place_at, double every_m) {
  tests::ShortSection section{.floor = {{0.0, kDepth_m}}, .water = {}, .sediment = {}};
  for (double range_m = 0.0; range_m < kRange_m + every_m; range_m += every_m) {
    const Place place = place_at(range_m);
    section.water.push_back({range_m, ocean::TabulatedProfile{{0.0}, {place.water_mps}}});
    section.sediment.push_back({range_m, {{0.0, place.sediment_mps, kDensity, place.attenuation_db_per_wavelength}}});
  }
  return section;
}

constexpr int kModes = 3;  ///< trapped at all ranges of the tests; the fourth is never

/// 0.02 dB, the accuracy that the solver is asked for when nobody says another.
const double kAccuracy = std::pow(10.0, 0.02 / 20.0) - 1.0;

TEST(AdiabaticModes, AreFollowedWhereNothingChanges) {
  const auto same = [](double) { return Place{1500.0, 2000.0, 0.1}; };
  EXPECT_LT(difference(tests::section_of(section_of(same, kRange_m)), adiabatic_pressure(same, kModes)), kAccuracy);
}

TEST(AdiabaticModes, AreFollowedThroughWaterThatChangesWithRange) {
  const auto warmer = [](double range_m) { return Place{1450.0 + 100.0 * range_m / kRange_m, 2000.0, 0.1}; };
  const std::vector<Complex> expected = adiabatic_pressure(warmer, kModes);
  EXPECT_LT(difference(tests::section_of(section_of(warmer, kRange_m)), expected), kAccuracy);
  const auto as_at_the_source = [](double) { return Place{1450.0, 2000.0, 0.1}; };
  EXPECT_GT(difference(tests::section_of(section_of(as_at_the_source, kRange_m)), expected), 0.2) << "the test would not notice";
}

/// Sediment that changes under a flat floor, in steps of a kilometre: at each, modes give a little of their energy to each other, which
/// the adiabatic field leaves out.
void expect_followed_over(const std::function<Place(double share)>& sediment, double ignored) {
  const auto in_steps = [&sediment](double range_m) { return sediment(std::floor(range_m / 1000.0) * 1000.0 / kRange_m); };
  const auto as_at_the_source = [&sediment](double) { return sediment(0.0); };
  const std::vector<Complex> expected = adiabatic_pressure(in_steps, kModes);
  EXPECT_LT(difference(tests::section_of(section_of(in_steps, 1000.0)), expected), 0.01);
  EXPECT_GT(difference(tests::section_of(section_of(as_at_the_source, kRange_m)), expected), ignored) << "the test would not notice";
}

TEST(AdiabaticModes, AreFollowedOverSedimentWhoseSoundSpeedChangesUnderAFlatFloor) {
  expect_followed_over([](double share) { return Place{1500.0, 2000.0 - 200.0 * share, 0.05}; }, 0.1);
}

TEST(AdiabaticModes, AreFollowedOverSedimentWhoseAttenuationChangesUnderAFlatFloor) {
  expect_followed_over([](double share) { return Place{1500.0, 2000.0, 0.05 + 1.45 * share}; }, 0.1);
}

}  // namespace
}  // namespace earshot::pe
