// The solver on its automatic grid against wavenumber integration (tests/oracles/wavenumber), in horizontally layered oceans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/pe/solver.hpp"
#include "tests/oracles/wavenumber/wavenumber.hpp"
#include "tests/reference/transmission_loss.hpp"
#include "tests/sim/pe/short_section.hpp"

namespace earshot::pe {
namespace {

struct Case {
  std::string name;
  ocean::TabulatedProfile water;
  double floor_m;
  std::vector<SedimentPoint> sediment;
  double frequency_hz;
  double source_m;
  double receiver_m;
  double max_range_m;
};

void PrintTo(const Case& c, std::ostream* stream) {
  *stream << c.name;
}

const ocean::TabulatedProfile kUniform{{0.0}, {1500.0}};

std::vector<SedimentPoint> half_space(double sound_speed_mps, double density, double attenuation) {
  return {{0.0, sound_speed_mps, density, attenuation}};
}

const std::vector<SedimentPoint> kSand = half_space(1700.0, 1.8, 0.5);

constexpr int kRows = 60;

std::vector<double> ranges_m(const Case& c) {
  std::vector<double> range_m;
  for (int i = 1; i <= kRows; ++i) range_m.push_back(c.max_range_m * i / kRows);
  return range_m;
}

/// The water in slices over which sound speed changes by as little as 0.2 m/s, or that are a sixtieth of a wavelength.
std::vector<oracle::Layer> water_layers(const Case& c) {
  std::vector<oracle::Layer> layers;
  const std::vector<double>& depth_m = c.water.depth_m;
  const std::vector<double>& speed_mps = c.water.sound_speed_mps;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    const double base_m = i + 1 < depth_m.size() ? depth_m[i + 1] : c.floor_m;
    const double base_mps = i + 1 < depth_m.size() ? speed_mps[i + 1] : speed_mps[i];
    const int slices = base_mps == speed_mps[i] ? 1 : 200;
    for (const oracle::Layer& layer : oracle::gradient(base_m - depth_m[i], speed_mps[i], base_mps, slices)) layers.push_back(layer);
  }
  return layers;
}

/// Its sediment consists of homogeneous layers.
oracle::LayeredOcean layered(const Case& c) {
  oracle::LayeredOcean ocean{water_layers(c), c.frequency_hz, c.source_m, c.receiver_m};
  for (std::size_t i = 0; i < c.sediment.size(); ++i) {
    const SedimentPoint& top = c.sediment[i];
    const double thickness_m = i + 1 < c.sediment.size() ? c.sediment[i + 1].depth_below_floor_m - top.depth_below_floor_m : 1.0;
    if (thickness_m > 0.0)
      ocean.layers.push_back({thickness_m, top.sound_speed_mps, top.density_g_per_cm3, top.attenuation_db_per_wavelength});
  }
  return ocean;
}

std::vector<double> loss_db(const std::vector<std::complex<double>>& pressure) {
  std::vector<double> loss;
  for (const auto& p : pressure) loss.push_back(-20.0 * std::log10(std::abs(p)));
  return loss;
}

std::vector<double> solved_loss_db(const Case& c, Options options) {
  options.output_step = Meters{c.max_range_m / kRows};
  const ocean::Section section =
      tests::section_of({.floor = {{0.0, c.floor_m}}, .water = {{0.0, c.water}}, .sediment = {{0.0, c.sediment}}});
  const Field field =
      solve(section, {Hertz{c.frequency_hz}, Meters{c.source_m}}, options, std::vector<double>{c.receiver_m}, Meters{c.max_range_m});
  return loss_db({field.pressure.data(), field.pressure.data() + field.pressure.size()});
}

/// Mean |difference| over all ranges beyond a wavelength, within which the solver claims nothing, and without points more than 10 dB below
/// the power mean of the seven about them, as tolerance_db of the reference cases.
double mean_difference_db(const Case& c, std::span<const double> computed, std::span<const double> truth) {
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < kRows; ++i) {
    double power = 0.0;
    int neighbours = 0;
    for (int j = std::max(0, i - 3); j <= std::min(kRows - 1, i + 3); ++j, ++neighbours)
      power += std::pow(10.0, -0.1 * truth[static_cast<std::size_t>(j)]);
    const auto here = static_cast<std::size_t>(i);
    if (ranges_m(c)[here] <= 1500.0 / c.frequency_hz || truth[here] > 10.0 - 10.0 * std::log10(power / neighbours)) continue;
    sum += std::abs(computed[here] - truth[here]);
    ++count;
  }
  return sum / count;
}

double error_db(const Case& c, const Options& options = {}) {
  return mean_difference_db(c, solved_loss_db(c, options), loss_db(oracle::pressure(layered(c), ranges_m(c))));
}

TEST(WavenumberOracle, AgreesWithTheFullWaveReferences) {
  Case pekeris{"", kUniform, 100.0, half_space(1700.0, 1.5, 0.5), 100.0, 36.0, 46.0, 6'000.0};
  oracle::LayeredOcean papers{{}, 20.0, 30.0, 300.0};
  for (int i = 0; i < 600; ++i) {
    const double eta = 2.0 * (5.0 * (i + 0.5) - 1300.0) / 1300.0;
    papers.layers.push_back({5.0, 1500.0 * (1.0 + 0.00737 * (eta + std::exp(-eta) - 1.0)), 1.0});
  }
  papers.layers.push_back({1.0, 1505.0, 1.5, 0.5});
  for (const auto& [name, ocean] : {std::pair{"pekeris", layered(pekeris)}, {"munk_20hz", papers}}) {
    const auto truth = reference::load(name);
    const std::vector<double> loss = loss_db(oracle::pressure(ocean, ranges_m(pekeris)));
    for (int i = 9; i < kRows; ++i) {  // in the whole dB range, minima too
      const auto range_m = static_cast<int>(std::lround(ranges_m(pekeris)[static_cast<std::size_t>(i)]));
      EXPECT_NEAR(loss[static_cast<std::size_t>(i)], truth.at(range_m), 0.002) << name << ' ' << range_m;
    }
  }
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}

class WavenumberIntegration : public testing::TestWithParam<Case> {};

TEST_P(WavenumberIntegration, IsWhatTheSolverFollowsWithinTheAccuracyAskedFor) {
  EXPECT_LT(error_db(GetParam()), 0.02);  // Options::accuracy; the project's bar is 0.05
}

Case over_sand(const std::string& name, double source_m, double receiver_m) {
  return {name, kUniform, 100.0, kSand, 100.0, source_m, receiver_m, 5'000.0};
}
Case over(const std::string& name, const std::vector<SedimentPoint>& sediment) {
  return {name, kUniform, 100.0, sediment, 100.0, 36.0, 46.0, 10'000.0};
}
Case thin(const std::string& name, double floor_m, const std::vector<SedimentPoint>& sediment, double frequency_hz = 20.0) {
  return {name, kUniform, floor_m, sediment, frequency_hz, 0.5 * floor_m, 0.7 * floor_m, 60'000.0 / frequency_hz};
}
Case thermocline(const std::string& name, double top_m, double thickness_m, double frequency_hz) {
  return {name, {{0.0, top_m, top_m + thickness_m}, {1540.0, 1540.0, 1500.0}}, 100.0, kSand, frequency_hz, 36.0, 46.0, 3'000.0};
}

const std::vector<SedimentPoint> kLayered{{0.0, 1600.0, 1.5, 0.2}, {20.0, 1600.0, 1.5, 0.2}, {20.0, 1900.0, 2.2, 0.1}};

INSTANTIATE_TEST_SUITE_P(
    SourcesAndReceivers, WavenumberIntegration,
    testing::Values(over_sand("AMetreAboveTheSeaFloor", 99.0, 46.0), over_sand("FortyCentimetresAboveTheSeaFloor", 99.6, 46.0),
                    over_sand("TenCentimetresAboveTheSeaFloor", 99.9, 46.0), over_sand("ACentimetreAboveTheSeaFloor", 99.99, 46.0),
                    over_sand("JustBelowTheSurface", 0.2, 46.0), over_sand("ReceiverOnTheSeaFloor", 46.0, 100.0),
                    Case{"AMetreAboveADeepSeaFloor", kUniform, 4'000.0, kSand, 20.0, 3'999.0, 300.0, 12'000.0},
                    Case{"ReceiverJustBelowTheSeaFloor", kUniform, 100.0, kLayered, 100.0, 46.0, 100.01, 3'000.0},
                    Case{"ReceiverJustAboveALayerInTheSediment", kUniform, 100.0, kLayered, 100.0, 46.0, 119.9, 3'000.0}),
    name_of);

INSTANTIATE_TEST_SUITE_P(Seabeds, WavenumberIntegration,
                         testing::Values(over("Silt", half_space(1500.0, 1.5, 0.02)), over("LosslessSilt", half_space(1500.0, 1.5, 0.0)),
                                         over("LosslessAndMatched", half_space(1500.0, 1.0, 0.0)),
                                         over("SlowerSilt", half_space(1490.0, 1.4, 0.02)),
                                         over("FasterSilt", half_space(1510.0, 1.5, 0.02)),
                                         over("LosslessSand", half_space(1700.0, 1.8, 0.0))),
                         name_of);

INSTANTIATE_TEST_SUITE_P(ThinWater, WavenumberIntegration,
                         testing::Values(thin("TenMetres", 10.0, kSand), thin("FifteenMetres", 15.0, kSand),
                                         thin("TwentyMetres", 20.0, kSand), thin("TenMetresOverMud", 10.0, half_space(1520.0, 1.5, 0.2)),
                                         thin("HundredMetresAtFiveHertz", 100.0, kSand, 5.0)),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Thermoclines, WavenumberIntegration,
                         testing::Values(thermocline("TwoMetresAtFiftyHertz", 30.0, 2.0, 50.0),
                                         thermocline("TwoMetresBetweenNodes", 37.3, 2.0, 50.0),
                                         thermocline("TwoMetresAtTwoHundredHertz", 30.0, 2.0, 200.0),
                                         thermocline("TwentyCentimetres", 30.1, 0.2, 100.0)),
                         name_of);

TEST(WavenumberReference, IsFollowedOnlyByAnAbsorberThickEnoughForTheSeabed) {
  const Case silt = over("", half_space(1500.0, 1.5, 0.02));
  EXPECT_GT(error_db(silt, {.absorber_wavelengths = 3.0}), 0.05);
  EXPECT_LT(error_db(silt, {.absorber_wavelengths = 150.0}), 0.005);
}

}  // namespace
}  // namespace earshot::pe
