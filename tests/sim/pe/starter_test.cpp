#include "sim/pe/starter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "sim/pe/solver.hpp"
#include "tests/sim/pe/short_section.hpp"

namespace earshot::pe {
namespace {

/// The floor is transparent: a half-space of water under a pressure-release surface.
const ocean::Section kBottomless = tests::section_of(
    {.floor = {{0.0, 500.0}}, .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}}, .sediment = {{0.0, {{0.0, 1500.0, 1.0, 0.0}}}}});

Field in_bottomless(Starter starter, double source_m, const std::vector<double>& depth) {
  const Options options{.output_step = Meters{100.0}, .accuracy = Decibels{0.002}, .starter = starter};
  return solve(kBottomless, {Hertz{100.0}, Meters{source_m}}, options, depth, Meters{600.0});
}

/// Far from it, a source with directivity D makes D(angle_1) exp(i k R1) / R1 - D(angle_2) exp(i k R2) / R2, its image above the surface.
template <class Directivity>
void expect_radiation(Starter starter, const Directivity& of_sine) {
  const double k = 2.0 * M_PI * 100.0 / 1500.0;
  const double source_m = 60.0;
  const std::vector<double> depth{60.0, 150.0, 260.0, 400.0};
  const Field field = in_bottomless(starter, source_m, depth);
  for (Eigen::Index column = 0; column < field.pressure.cols(); ++column) {
    for (const Eigen::Index row : {3, 4, 5}) {  // 400 to 600 m: angles to 49 degrees
      const double range_m = 100.0 * static_cast<double>(row + 1);
      const double receiver_m = depth[static_cast<std::size_t>(column)];
      const auto wave = [&](double vertical_m) {
        const double slant_m = std::hypot(range_m, vertical_m);
        return std::polar(of_sine(vertical_m / slant_m) / slant_m, k * slant_m);
      };
      const double exact = std::abs(wave(receiver_m - source_m) - wave(receiver_m + source_m));
      // 2 percent of the direct wave: the next term of stationary phase is about 1 / (k R), 0.6 percent; the rest is the grid.
      EXPECT_NEAR(std::abs(field.pressure(row, column)), exact, 0.02 / std::hypot(range_m, receiver_m - source_m))
          << range_m << ' ' << receiver_m;
    }
  }
}

TEST(Starter, GaussianRadiatesItsClosedFormAtEveryAngle) {
  expect_radiation(Starter::kGaussian, [](double sine) { return std::exp(-0.5 * sine * sine); });
}

TEST(Starter, SelfRadiatesAsAPointSourceAtEveryAngle) {
  expect_radiation(Starter::kSelf, [](double) { return 1.0; });
}

TEST(Starter, GaussianIsAsMuchQuieterThanSelfFarOffAsTheAnglesOfTrappedWavesSay) {
  const ocean::Section papers_ocean =
      tests::section_of({.floor = {{0.0, 3000.0}},
                         .water = {{0.0, ocean::MunkProfile{MetersPerSecond{1500.0}, Meters{1300.0}, Meters{1300.0}, 0.00737}}},
                         .sediment = {{0.0, {{0.0, 1505.0, 1.5, 0.5}}}}});
  const auto intensity = [&](Starter starter) {
    const Options options{.output_step = Meters{50.0}, .starter = starter};
    const Field field = solve(papers_ocean, {Hertz{20.0}, Meters{1'000.0}}, options, std::vector<double>{1'000.0}, Meters{100'000.0});
    return field.pressure.abs2().bottomRows(800).mean();
  };
  // Waves that miss the floor leave 1000 m at up to acos(1501.4 / 1518.7) = 8.65 degrees: 10 log10 exp(sin^2) from 0 to 0.098 dB.
  const double difference_db = 10.0 * std::log10(intensity(Starter::kSelf) / intensity(Starter::kGaussian));
  EXPECT_GT(difference_db, 0.01);
  EXPECT_LT(difference_db, 0.0983);
}

}  // namespace
}  // namespace earshot::pe
