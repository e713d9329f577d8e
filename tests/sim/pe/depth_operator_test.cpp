#include "sim/pe/depth_operator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

namespace earshot::pe {
namespace {

using Complex = std::complex<double>;

constexpr double kFrequency = 20.0;
constexpr double kDepth_m = 600.0;
constexpr double kSediment_m = 400.0;
constexpr double kWaterSpeed = 1500.0;
constexpr double kSedimentSpeed = 1700.0;
constexpr double kDensity = 1.8;
constexpr double kReference = 2.0 * M_PI * kFrequency / kWaterSpeed;

DepthGrid two_media(double step_m) {
  return make_depth_grid(ocean::TabulatedProfile{{0.0}, {kWaterSpeed}},
                         {.depth = Meters{kDepth_m},
                          .layers = {{.thickness = Meters{kSediment_m},
                                      .sound_speed = MetersPerSecond{kSedimentSpeed},
                                      .density_g_per_cm3 = kDensity,
                                      .attenuation_db_per_wavelength = 0.0},
                                     {.thickness = {},
                                      .sound_speed = MetersPerSecond{kSedimentSpeed},
                                      .density_g_per_cm3 = kDensity,
                                      .attenuation_db_per_wavelength = 0.0}}},
                         Hertz{kFrequency}, {.step = Meters{step_m}, .absorber_wavelengths = 4.0});
}

/// A wave of horizontal wavenumber kr through both media: sine above, and below what continuity of pressure and of (1/rho) dp/dz makes of
/// it.
struct ExactWave {
  double kr = 0.9 * 2.0 * M_PI * kFrequency / kSedimentSpeed;
  double above = std::sqrt(std::pow(2.0 * M_PI * kFrequency / kWaterSpeed, 2) - kr * kr);
  double below = std::sqrt(std::pow(2.0 * M_PI * kFrequency / kSedimentSpeed, 2) - kr * kr);

  [[nodiscard]] double operator()(double z) const {
    if (z <= kDepth_m) return std::sin(above * z);
    return std::sin(above * kDepth_m) * std::cos(below * (z - kDepth_m)) +
           kDensity * above / below * std::cos(above * kDepth_m) * std::sin(below * (z - kDepth_m));
  }
  [[nodiscard]] double eigenvalue() const { return kr * kr / (kReference * kReference) - 1.0; }
};

/// Residual of G p = X M p for the exact wave at a node, as an error of X.
double residual(double step_m, double depth_m) {
  const DepthOperator op = make_depth_operator(two_media(step_m), kReference);
  const ExactWave wave;
  const auto i = static_cast<std::size_t>(std::lround(depth_m / step_m)) - 1;
  const auto apply = [&](const Tridiagonal& t) {
    return t.lower[i] * wave(depth_m - step_m) + t.diagonal[i] * wave(depth_m) + t.upper[i] * wave(depth_m + step_m);
  };
  return std::abs((apply(op.g) - wave.eigenvalue() * apply(op.mass)) / op.mass.diagonal[i]);
}

TEST(DepthOperator, IsFourthOrderInsideAMedium) {
  const double ratio = residual(10.0, 300.0) / residual(5.0, 300.0);
  EXPECT_NEAR(ratio, 16.0, 0.5);  // 2^4; the next order contributes (kz step)^2 / 12 of it
}

TEST(DepthOperator, IsThirdOrderTimesTheStepAtAnInterfaceWithADensityJump) {
  // One node's flux error of order step^3 over a mass of order step: the residual falls with step^2, the solution's error with step^3.
  const double ratio = residual(10.0, 600.0) / residual(5.0, 600.0);
  EXPECT_NEAR(ratio, 4.0, 0.5);
}

TEST(DepthOperator, HoldsNoPressureAtTheSurface) {
  const DepthOperator op = make_depth_operator(two_media(10.0), kReference);
  EXPECT_EQ(op.mass.lower.front(), Complex(0.0));
  EXPECT_EQ(op.g.lower.front(), Complex(0.0));
}

}  // namespace
}  // namespace earshot::pe
