#include "sim/pe/depth_operator.hpp"
#include "tests/sim/pe/short_section.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <vector>

namespace earshot::pe {
namespace {

constexpr Hertz kFrequency{100.0};

ocean::Section waveguide(double depth_m) {
  return tests::section_of({.floor = {{0.0, depth_m}},
                            .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                            .sediment = {{0.0, {{0.0, 1700.0, 1.5, 0.5}}}}});
}

/// Horizontal wavenumbers of the modes that decay least.
std::vector<std::complex<double>> modes(const ocean::Section& section, double step_m, std::size_t count) {
  const DepthGrid grid = make_depth_grid(section, kFrequency, Meters{step_m}, choose_absorber(section, kFrequency, Meters{20'000.0}, {}));
  const DepthOperator op(section, kFrequency, grid);
  const auto n = static_cast<Eigen::Index>(grid.intervals) - 1;
  Eigen::MatrixXcd m = Eigen::MatrixXcd::Zero(n, n);
  Eigen::MatrixXcd g = m;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i + 1);
    m(i, i) = op.mass().diagonal[row], g(i, i) = op.g().diagonal[row];
    if (i + 1 < n) m(i, i + 1) = m(i + 1, i) = op.mass().off[row], g(i, i + 1) = g(i + 1, i) = op.g().off[row];
  }
  const Eigen::VectorXcd x = Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(m.partialPivLu().solve(g), false).eigenvalues();
  std::vector<std::complex<double>> k;
  for (const auto eigenvalue : x) k.push_back(grid.reference_wavenumber_per_m * std::sqrt(1.0 + eigenvalue));
  std::sort(k.begin(), k.end(), [](auto a, auto b) { return a.real() - 100.0 * a.imag() > b.real() - 100.0 * b.imag(); });
  k.resize(count);
  return k;
}

TEST(DepthOperator, HasTheModesOfThePekerisWaveguide) {
  // modes_kr of the reference case pekeris: analytic roots, made elsewhere.
  const std::vector<std::complex<double>> exact{
      {0.417859413249863, 4.568674180509202e-06},   {0.4147770240428116, 1.773706548988293e-05},
      {0.4095646710091603, 3.8585181299336374e-05}, {0.40212035754660164, 6.767708746997284e-05},
      {0.3923218171962185, 0.00011111477320142202}, {0.38007880192838817, 0.00020258502518476524}};
  const auto found = modes(waveguide(100.0), 0.8, 6);  // the sea floor lies on a node
  // 0.8 m is a nineteenth of a wavelength: the steepest mode is off by 1e-7 of its wavenumber, 0.0008 rad in 20 km.
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(std::abs(found[i] - exact[i]), 2e-7) << i;
}

TEST(DepthOperator, ConvergesWithTheFourthPowerOfTheStepInTheWater) {
  const std::complex<double> exact{0.38007880192838817, 0.00020258502518476524};
  const double coarse = std::abs(modes(waveguide(100.0), 2.5, 6)[5] - exact);
  const double fine = std::abs(modes(waveguide(100.0), 1.25, 6)[5] - exact);
  EXPECT_GT(coarse / fine, 13.0);  // 2^4 = 16 in the limit
}

TEST(DepthOperator, LetsTheSeaFloorLieBetweenNodes) {
  // A floor at 100 m on grids whose nodes miss it by every fraction of a step.
  const std::complex<double> exact{0.4095646710091603, 3.8585181299336374e-05};
  for (const double step : {0.97, 0.99, 1.01, 1.03, 1.05}) {
    EXPECT_LT(std::abs(modes(waveguide(100.0), step, 6)[2] - exact), 5e-6) << step;  // RAM's floor on the nearest node: 3e-5 at 0.5 m
  }
}

TEST(DepthOperator, TakesItsInterfacesAlongWithTheFloorAndTheSediment) {
  ocean::Section section = waveguide(100.0);
  section.sea_floor.push_back({.range = Meters{1'000.0}, .depth = Meters{80.0}});
  const ocean::Section layered =
      tests::section_of({.floor = {{0.0, 100.0}},
                         .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                         .sediment = {{0.0, {{0.0, 1550.0, 1.4, 0.5}, {6.0, 1550.0, 1.4, 0.5}, {6.0, 1700.0, 1.9, 0.5}}}}});
  section.sediment.push_back({.range = Meters{400.0}, .layers = layered.sediment.front().layers});
  const DepthGrid grid = make_depth_grid(section, kFrequency, Meters{1.0}, choose_absorber(section, kFrequency, Meters{1'000.0}, {}));
  DepthOperator op(section, kFrequency, grid);
  ASSERT_EQ(op.interfaces().size(), 1U);
  EXPECT_EQ(op.interfaces()[0].depth_m, 100.0);
  op.move_to(250.0);
  ASSERT_EQ(op.interfaces().size(), 1U);
  EXPECT_EQ(op.interfaces()[0].depth_m, 95.0);
  op.move_to(500.0);
  ASSERT_EQ(op.interfaces().size(), 2U);
  EXPECT_EQ(op.interfaces()[0].depth_m, 90.0);
  EXPECT_EQ(op.interfaces()[1].depth_m, 96.0);
}

TEST(DepthOperator, ChangesOnlyRowsAtTheSeaFloorWhenOnlyTheFloorMoves) {
  ocean::Section section = waveguide(100.0);
  section.sea_floor.push_back({.range = Meters{1'000.0}, .depth = Meters{80.0}});
  const DepthGrid grid = make_depth_grid(section, kFrequency, Meters{1.0}, choose_absorber(section, kFrequency, Meters{1'000.0}, {}));
  DepthOperator moved(section, kFrequency, grid);
  const DepthOperator before = moved;
  const RowRange changed = moved.rows_changed_by(500.0);
  EXPECT_EQ(changed.first, 90U);
  EXPECT_EQ(changed.last, 101U);
  moved.move_to(500.0);
  for (std::size_t i = 1; i < grid.intervals; ++i) {
    const bool same = moved.mass().diagonal[i] == before.mass().diagonal[i] && moved.g().diagonal[i] == before.g().diagonal[i];
    EXPECT_EQ(same, i < changed.first || i > changed.last - 1) << i;
  }
  EXPECT_TRUE(moved.rows_changed_by(500.0).empty());
}

}  // namespace
}  // namespace earshot::pe
