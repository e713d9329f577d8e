#include "sim/pe/solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/reference/transmission_loss.hpp"

namespace earshot::pe {
namespace {

ocean::SedimentLayer half_space(double sound_speed_mps, double density, double attenuation) {
  return {.thickness = {},
          .sound_speed = MetersPerSecond{sound_speed_mps},
          .density_g_per_cm3 = density,
          .attenuation_db_per_wavelength = attenuation};
}

ocean::Environment papers_ocean() {
  ocean::Environment environment;
  environment.water = ocean::MunkProfile{MetersPerSecond{1500.0}, Meters{1300.0}, Meters{1300.0}, 0.00737};
  environment.seabed = {.depth = Meters{3000.0}, .layers = {half_space(1505.0, 1.5, 0.5)}};
  environment.source = {.frequency = Hertz{20.0}, .level = {}, .depth = Meters{30.0}, .position = {}};
  return environment;
}

ocean::Environment pekeris() {
  ocean::Environment environment;
  environment.water = ocean::TabulatedProfile{{0.0}, {1500.0}};
  environment.seabed = {.depth = Meters{100.0}, .layers = {half_space(1700.0, 1.5, 0.5)}};
  environment.source = {.frequency = Hertz{100.0}, .level = {}, .depth = Meters{36.0}, .position = {}};
  return environment;
}

reference::TransmissionLoss loss_of(const Field& field, Eigen::Index column = 0) {
  reference::TransmissionLoss loss;
  for (Eigen::Index row = 0; row < field.pressure.rows(); ++row) {
    loss[static_cast<int>(std::lround(static_cast<double>(row + 1) * field.range_step.value))] =
        -20.0 * std::log10(std::abs(field.pressure(row, column)));
  }
  return loss;
}

Field solve_at(const ocean::Environment& environment, double depth_m, double max_range_m, const Options& options) {
  return solve(environment, options, std::vector<double>{depth_m}, Meters{max_range_m});
}

TEST(Solver, FollowsTheFullWaveReferenceOfThePapersOcean) {
  const auto truth = reference::load("munk_20hz");
  const auto loss = loss_of(solve_at(papers_ocean(), 300.0, 100'000.0, {.depth_step = {}, .range_step = Meters{10.0}}));
  const auto audible = reference::compare(loss, truth, 500, 25'000, [](int, double tl) { return tl >= 110.0; });
  EXPECT_GT(audible.count, 2000);
  EXPECT_LT(audible.root_mean_square_db, 0.05);  // the project's bar is 0.5 dB; deep minima raise it above the mean
  const reference::DeepMinimum skip(truth, 1500);
  EXPECT_LT(reference::compare(loss, truth, 1000, 25'000, skip).mean_db, 0.03);     // tolerance_db of the case
  EXPECT_LT(reference::compare(loss, truth, 25'000, 100'000, skip).mean_db, 0.05);  // likewise
}

TEST(Solver, FollowsTheFullWaveReferenceOfThePekerisWaveguide) {
  const auto truth = reference::load("pekeris");
  const auto loss = loss_of(solve_at(pekeris(), 46.0, 20'000.0, {.depth_step = {}, .range_step = Meters{2.0}}));
  const reference::DeepMinimum skip(truth, 300);
  EXPECT_LT(reference::compare(loss, truth, 500, 2'000, skip).mean_db, 0.1);     // tolerance_db of the case
  EXPECT_LT(reference::compare(loss, truth, 2'000, 20'000, skip).mean_db, 0.1);  // likewise
}

TEST(Solver, MakesTheLloydMirrorOfADeepUniformOcean) {
  // p = exp(i k R1) / R1 - exp(i k R2) / R2, source and its image above the surface; the floor is transparent.
  ocean::Environment environment = pekeris();
  environment.seabed = {.depth = Meters{500.0}, .layers = {half_space(1500.0, 1.0, 0.0)}};
  const double k = 2.0 * M_PI * 100.0 / 1500.0;
  const double source_m = 36.0;
  const double receiver_m = 50.0;
  const Field field = solve_at(environment, receiver_m, 5'000.0, {.depth_step = {}, .range_step = Meters{5.0}});
  for (Eigen::Index row = 39; row < field.pressure.rows(); row += 20) {
    const double range_m = 5.0 * static_cast<double>(row + 1);
    const double direct = std::hypot(range_m, receiver_m - source_m);
    const double image = std::hypot(range_m, receiver_m + source_m);
    const double exact = std::abs(std::polar(1.0 / direct, k * direct) - std::polar(1.0 / image, k * image));
    // 2 percent of the direct wave: at 200 m the Hankel function's asymptotic form is 1 / (8 k r) = 0.15 percent off in phase, the rest is
    // the grid.
    EXPECT_NEAR(std::abs(field.pressure(row, 0)), exact, 0.02 / direct) << range_m;
  }
}

TEST(Solver, IsReciprocal) {
  ocean::Environment there = papers_ocean();
  ocean::Environment back = papers_ocean();
  back.source.depth = Meters{300.0};
  const Options options{.depth_step = Meters{5.0}, .range_step = Meters{20.0}};
  const Field forth = solve_at(there, 300.0, 10'000.0, options);
  const Field reverse = solve_at(back, 30.0, 10'000.0, options);
  const double scale = forth.pressure.abs().bottomRows(400).mean();
  // 1 percent of the mean pressure: both ends are interpolated between nodes of the same grid.
  EXPECT_LT((forth.pressure - reverse.pressure).abs().bottomRows(400).maxCoeff(), 0.01 * scale);
}

TEST(Solver, ConvergesWithTheFourthPowerOfTheDepthStep) {
  const auto at = [](double depth_step_m) {
    return solve_at(papers_ocean(), 300.0, 10'000.0, {.depth_step = Meters{depth_step_m}, .range_step = Meters{20.0}});
  };
  const Field fine = at(1.5);
  const auto error = [&](double depth_step_m) { return (at(depth_step_m).pressure - fine.pressure).abs().bottomRows(300).mean(); };
  EXPECT_GT(error(12.0) / error(6.0), 11.0);  // 2^4 = 16 in the limit, 2^3 = 8 at the interface alone
}

TEST(Solver, RefusesWhatLiesOutsideTheWater) {
  EXPECT_THROW((void)solve_at(pekeris(), 100.1, 1'000.0, {}), std::invalid_argument);
  EXPECT_THROW((void)solve_at(pekeris(), -1.0, 1'000.0, {}), std::invalid_argument);
  EXPECT_THROW((void)solve_at(pekeris(), std::numeric_limits<double>::quiet_NaN(), 1'000.0, {}), std::invalid_argument);
  EXPECT_THROW((void)solve_at(pekeris(), 50.0, 0.0, {}), std::invalid_argument);
  EXPECT_THROW((void)solve_at(pekeris(), 50.0, 1'000.0, {.depth_step = {}, .range_step = {}, .terms = 17}), std::invalid_argument);
}

TEST(Solver, HoldsNoPressureAtTheSurface) {
  const Field field = solve_at(pekeris(), 0.0, 500.0, {});
  EXPECT_EQ(field.pressure.abs().maxCoeff(), 0.0);
}

}  // namespace
}  // namespace earshot::pe
