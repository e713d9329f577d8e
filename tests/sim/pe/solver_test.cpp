#include "sim/pe/solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/reference/transmission_loss.hpp"
#include "tests/sim/pe/short_section.hpp"

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

ocean::Section flat_section(const ocean::Environment& environment) {
  return {.water = {{.range = Meters{}, .profile = environment.water}},
          .sea_floor = {{.range = Meters{}, .depth = environment.seabed.depth}},
          .sediment = {{.range = Meters{}, .layers = environment.seabed.layers}},
          .absorption_db_per_km = environment.absorption_db_per_km};
}

Field solve_at(const ocean::Environment& environment, double depth_m, double max_range_m, const Options& options) {
  return solve(flat_section(environment), {environment.source.frequency, environment.source.depth}, options, std::vector<double>{depth_m},
               Meters{max_range_m});
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

ocean::SoundSpeedProfile munk() {
  return papers_ocean().water;
}

ocean::Section asa_wedge() {
  return tests::section_of({.floor = {{0.0, 200.0}, {4'000.0, 0.0}},
                            .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                            .sediment = {{0.0, {{0.0, 1700.0, 1.5, 0.5}}}}});
}

ocean::Section upslope() {
  return tests::section_of({.floor = {{0.0, 3000.0}, {5'000.0, 3000.0}, {25'000.0, 1000.0}, {35'000.0, 1000.0}},
                            .water = {{0.0, munk()}},
                            .sediment = {{0.0, {{0.0, 1600.0, 1.8, 0.5}}}}});
}

Options every(double output_step_m) {
  return {.output_step = Meters{output_step_m}};
}

TEST(Solver, FollowsTheFullWaveReferenceOnTheAutomaticGrid) {
  const auto deep = reference::load("munk_20hz");
  const auto loss = loss_of(solve_at(papers_ocean(), 300.0, 100'000.0, every(10.0)));
  const reference::DeepMinimum skip(deep, 1500);
  EXPECT_LT(reference::compare(loss, deep, 1'000, 25'000, skip).mean_db, 0.02);  // the accuracy asked for; the case asks for 0.03
  EXPECT_LT(reference::compare(loss, deep, 25'000, 100'000, skip).mean_db, 0.012);
  const auto shallow = reference::load("pekeris");
  const auto shallow_loss = loss_of(solve_at(pekeris(), 46.0, 20'000.0, every(10.0)));
  EXPECT_LT(reference::compare(shallow_loss, shallow, 500, 20'000, reference::DeepMinimum(shallow, 300)).mean_db, 0.012);
}

TEST(Solver, FollowsTheFullWaveReferenceOfTheAsaWedge) {
  const Field field = solve(asa_wedge(), {Hertz{25.0}, Meters{100.0}}, every(5.0), std::vector<double>{30.0, 150.0}, Meters{3'900.0});
  const std::vector<double> tolerance_db{0.15, 0.25};  // tolerance_db of the case
  for (const int column : {0, 1}) {
    const auto truth = reference::load("asa_wedge", column);
    const auto difference = reference::compare(loss_of(field, column), truth, 500, 3'900, reference::DeepMinimum(truth, 300));
    EXPECT_GT(difference.count, 600);
    EXPECT_LT(difference.mean_db, tolerance_db[static_cast<std::size_t>(column)]);
  }
}

TEST(Solver, ComesFourTimesCloserToTheFullWaveOnASlopeThanAPressureMatchedPe) {
  const Field field =
      solve(upslope(), {Hertz{20.0}, Meters{30.0}}, every(25.0), std::vector<double>{100.0, 300.0, 800.0}, Meters{35'000.0});
  for (const int column : {0, 1, 2}) {
    const auto truth = reference::load("upslope_deep", column);
    const auto difference = reference::compare(loss_of(field, column), truth, 1'000, 35'000, reference::DeepMinimum(truth, 1500));
    EXPECT_LT(difference.mean_db, 0.17) << column;  // RAM converges to 0.65-0.87 dB; what is left is backscatter and one-way coupling
  }
}

TEST(Solver, PredictsItsErrorOnASlope) {
  const auto at = [](double accuracy_db) {
    Options options = every(10.0);
    options.accuracy = Decibels{accuracy_db};
    return loss_of(solve(asa_wedge(), {Hertz{25.0}, Meters{100.0}}, options, std::vector<double>{30.0}, Meters{3'900.0}));
  };
  const auto fine = at(0.001);
  for (const double accuracy : {0.02, 0.05, 0.1}) {
    const auto difference = reference::compare(at(accuracy), fine, 500, 3'900, reference::DeepMinimum(fine, 300));
    EXPECT_LT(difference.mean_db, 1.5 * accuracy) << accuracy;  // a mean over one ocean scatters about the prediction
  }
}

TEST(Solver, FindsTheSamePressureInsideALongStepAsAtTheEndOfShortOnes) {
  const Options in_long_steps{.depth_step = Meters{5.0}, .range_step = Meters{200.0}, .terms = 16, .output_step = Meters{25.0}};
  const Options in_short_steps{.depth_step = Meters{5.0}, .range_step = Meters{25.0}, .terms = 16, .output_step = Meters{25.0}};
  const Field a = solve_at(papers_ocean(), 300.0, 10'000.0, in_long_steps);
  const Field b = solve_at(papers_ocean(), 300.0, 10'000.0, in_short_steps);
  ASSERT_EQ(a.pressure.rows(), b.pressure.rows());
  const double scale = b.pressure.abs().bottomRows(360).mean();
  EXPECT_LT((a.pressure - b.pressure).abs().bottomRows(360).mean(), 1e-3 * scale);  // 400 steps of 1e-6, steep waves more
}

TEST(Solver, KeepsTheEnergyOfALosslessChannel) {
  // Energy flux of trapped waves, int |p|^2 / rho r dz x k_r, over a hard, lossless floor; modes beat in depth, not in the integral.
  const ocean::Section section = tests::section_of({.floor = {{0.0, 200.0}},
                                                    .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                                                    .sediment = {{0.0, {{0.0, 1600.0, 1.5, 0.0}}}}});
  std::vector<double> depth;
  for (double z = 2.0; z < 200.0; z += 2.0) depth.push_back(z);
  const Field field = solve(section, {Hertz{50.0}, Meters{100.0}}, every(500.0), depth, Meters{100'000.0});
  const auto flux = [&](Eigen::Index first) {  // mean over 10 km, many beats
    double sum = 0.0;
    for (Eigen::Index row = first; row < first + 20; ++row) sum += field.pressure.row(row).abs2().sum() * static_cast<double>(row + 1);
    return sum;
  };
  EXPECT_NEAR(flux(180) / flux(80), 1.0, 0.01);  // 0.04 dB in 50 km: what is left of the beats
}

TEST(Solver, IsReciprocalOverASlopeWithinItsOneWayLimit) {
  // Source and receiver change places, and the slope its direction: 200 m deep here, 120 m there.
  const auto section = [](double near_m, double far_m) {
    return tests::section_of({.floor = {{0.0, near_m}, {5'000.0, far_m}},
                              .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                              .sediment = {{0.0, {{0.0, 1700.0, 1.5, 0.5}}}}});
  };
  Options options = every(5'000.0);
  options.accuracy = Decibels{0.01};
  for (const double z : {30.0, 60.0, 90.0}) {
    const auto up = solve(section(200.0, 120.0), {Hertz{50.0}, Meters{100.0}}, options, std::vector<double>{z}, Meters{5'000.0});
    const auto down = solve(section(120.0, 200.0), {Hertz{50.0}, Meters{z}}, options, std::vector<double>{100.0}, Meters{5'000.0});
    EXPECT_NEAR(20.0 * std::log10(std::abs(up.pressure(0, 0)) / std::abs(down.pressure(0, 0))), 0.0, 0.15)
        << z;  // one-way error of a slope
  }
}

TEST(Solver, ConvergesWithTheSecondPowerOfTheRangeStepOnASlope) {
  const auto at = [](double step_m) {
    const Options options{.depth_step = Meters{2.5}, .range_step = Meters{step_m}, .terms = 16, .output_step = Meters{80.0}};
    return solve(asa_wedge(), {Hertz{25.0}, Meters{100.0}}, options, std::vector<double>{60.0}, Meters{3'200.0});
  };
  const Field fine = at(5.0);
  const auto error = [&](double step_m) { return (at(step_m).pressure - fine.pressure).abs().bottomRows(30).mean(); };
  EXPECT_GT(error(40.0) / error(20.0), 2.5);  // 4 in the limit
}

TEST(Solver, FollowsASectionThatEndsBeforeTheRangeDoes) {
  ocean::Section flat = asa_wedge();
  flat.sea_floor = tests::sea_floor({{0.0, 200.0}, {100.0, 200.0}});
  ocean::Section same = asa_wedge();
  same.sea_floor = tests::sea_floor({{0.0, 200.0}});
  const auto a = solve(flat, {Hertz{25.0}, Meters{100.0}}, every(50.0), std::vector<double>{50.0}, Meters{3'000.0});
  const auto b = solve(same, {Hertz{25.0}, Meters{100.0}}, every(50.0), std::vector<double>{50.0}, Meters{3'000.0});
  EXPECT_LT((a.pressure - b.pressure).abs().maxCoeff(), 1e-9 * b.pressure.abs().maxCoeff());  // only the order of elimination differs
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

TEST(Solver, IsReciprocalBesideTheSeaFloor) {
  const Options options{.depth_step = Meters{0.77}, .range_step = Meters{20.0}};  // the floor lies between nodes
  for (const double above_m : {1.0, 0.4, 0.1, 0.01}) {
    ocean::Environment there = pekeris();
    ocean::Environment back = pekeris();
    there.source.depth = Meters{100.0 - above_m};
    const Field forth = solve_at(there, 36.0, 4'000.0, options);
    const Field reverse = solve_at(back, 100.0 - above_m, 4'000.0, options);
    const double scale = forth.pressure.abs().mean();
    EXPECT_LT((forth.pressure - reverse.pressure).abs().bottomRows(150).maxCoeff(), 1e-4 * scale) << above_m;  // to the fourth order exact
  }
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

TEST(Solver, RefusesTermsAndStepsThatCannotCarryTheSound) {
  // 22 dB off in 8 km; 14 dB off in 25 km; 16 dB; 25 dB, of waves that grow eightfold a step.
  const std::vector<std::pair<Options, double>> useless{{{.terms = 2, .output_step = Meters{1'000.0}}, 8'000.0},
                                                        {{.terms = 4}, 25'000.0},
                                                        {{.range_step = Meters{5'000.0}}, 25'000.0},
                                                        {{.range_step = Meters{2'000.0}}, 25'000.0}};
  for (const auto& [options, range_m] : useless) {
    try {
      (void)solve_at(papers_ocean(), 300.0, range_m, options);
      ADD_FAILURE() << options.terms << " terms to " << range_m << " m";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("take more terms or a shorter range step"), std::string::npos) << error.what();
    }
  }
  EXPECT_NO_THROW((void)solve_at(papers_ocean(), 300.0, 25'000.0, {.range_step = Meters{500.0}}));             // 0.002 dB off
  EXPECT_NO_THROW((void)solve_at(papers_ocean(), 300.0, 25'000.0, {.range_step = Meters{50.0}, .terms = 8}));  // 0.05 dB, as RAM is used
}

TEST(Solver, RefusesStepsThatDoNotDivideEachOther) {
  EXPECT_THROW((void)solve_at(pekeris(), 50.0, 1'000.0, {.range_step = Meters{7.0}, .output_step = Meters{10.0}}), std::invalid_argument);
  EXPECT_NO_THROW((void)solve_at(pekeris(), 50.0, 100.0, {.range_step = Meters{5.0}, .output_step = Meters{10.0}}));
  EXPECT_THROW((void)solve_at(pekeris(), 50.0, 100.0, {.accuracy = Decibels{0.0}}), std::invalid_argument);
  EXPECT_NO_THROW((void)solve_at(pekeris(), 50.0, 100.0, {.absorber_wavelengths = 0.5}));
  EXPECT_NO_THROW((void)solve_at(pekeris(), 50.0, 0.1, {.range_step = Meters{0.01}, .output_step = Meters{0.01}}));
  EXPECT_THROW((void)solve_at(pekeris(), 50.0, 0.1, {.range_step = Meters{0.0099}, .output_step = Meters{0.0099}}), std::invalid_argument);
  EXPECT_THROW((void)solve_at(pekeris(), 50.0, 100.0, {.absorber_wavelengths = 0.499}), std::invalid_argument);
}

TEST(Solver, TellsByHowMuchStepsDoNotDivideEachOther) {
  try {
    (void)solve_at(pekeris(), 50.0, 1'000.0, {.range_step = Meters{4.0}, .output_step = Meters{10.0}});
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("2.5"), std::string::npos) << e.what();
  }
}

TEST(Solver, TakesForAStepTheMediumInItsMiddle) {
  const auto field_of = [](double sediment_changes_at_m) {
    const ocean::Section section =
        tests::section_of({.floor = {{0.0, 100.0}},
                           .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                           .sediment = {{0.0, {{0.0, 1700.0, 1.5, 0.5}}}, {sediment_changes_at_m, {{0.0, 1600.0, 1.5, 0.5}}}}});
    const Options options{.depth_step = Meters{2.0}, .range_step = Meters{20.0}, .terms = 8, .output_step = Meters{20.0}};
    return solve(section, {Hertz{50.0}, Meters{30.0}}, options, std::vector<double>{60.0}, Meters{400.0}).pressure;
  };
  // Steps of 20 m have their middles at 10 m, 30 m, 50 m, ...
  EXPECT_TRUE((field_of(10.05) == field_of(29.95)).all()) << "the same for every step";
  EXPECT_FALSE((field_of(29.95) == field_of(30.05)).all());
  EXPECT_TRUE((field_of(30.05) == field_of(49.95)).all());
  EXPECT_TRUE((field_of(0.05) == field_of(9.95)).all()) << "the first step has the second medium; the source is in the first";
  EXPECT_FALSE((field_of(9.95) == field_of(10.05)).all());
}

TEST(Solver, LosesWhatSeaWaterAbsorbsPerKilometre) {
  const auto loss_at_10_km = [](double absorption_db_per_km) {
    ocean::Environment environment = pekeris();
    environment.absorption_db_per_km = absorption_db_per_km;
    return loss_of(solve_at(environment, 46.0, 10'000.0, every(1'000.0))).at(10'000);
  };
  // 10 km x 2 dB/km, and 4 percent more at most: the modes that are left travel at less than 16 degrees, and pass through sediment too.
  const double difference_db = loss_at_10_km(2.0) - loss_at_10_km(0.0);
  EXPECT_GT(difference_db, 19.5);
  EXPECT_LT(difference_db, 20.8);
}

TEST(Solver, TakesAGradientInTheSedimentForWhatManyThinLayersMake) {
  constexpr int kSlices = 40;
  const double thickness_m = 60.0;
  ocean::Environment smooth = pekeris();
  ocean::SedimentLayer top = half_space(1480.0, 1.3, 0.1);
  top.thickness = Meters{thickness_m};
  top.sound_speed_at_base = MetersPerSecond{1700.0};
  top.density_at_base_g_per_cm3 = 1.9;
  top.attenuation_at_base_db_per_wavelength = 0.7;
  smooth.seabed.layers = {top, half_space(1800.0, 2.0, 0.5)};
  ocean::Environment sliced = pekeris();
  sliced.seabed.layers.clear();
  for (int i = 0; i < kSlices; ++i) {
    const double share = (i + 0.5) / kSlices;
    ocean::SedimentLayer slice = half_space(1480.0 + 220.0 * share, 1.3 + 0.6 * share, 0.1 + 0.6 * share);
    slice.thickness = Meters{thickness_m / kSlices};
    sliced.seabed.layers.push_back(slice);
  }
  sliced.seabed.layers.push_back(half_space(1800.0, 2.0, 0.5));
  const Options options{.depth_step = Meters{0.5}, .output_step = Meters{50.0}};
  const auto a = solve_at(smooth, 46.0, 10'000.0, options);
  const auto b = solve_at(sliced, 46.0, 10'000.0, options);
  const auto uniform = solve_at(pekeris(), 46.0, 10'000.0, options);
  const auto difference = [&a](const Field& other) {  // of moduli: each field has a reference phase of its own
    return (a.pressure.abs() - other.pressure.abs()).abs().mean() / a.pressure.abs().mean();
  };
  EXPECT_LT(difference(b), 0.01);       // a slice is a tenth of a wavelength; its error goes with the square
  EXPECT_GT(difference(uniform), 0.3);  // another sea floor altogether
}

TEST(Solver, HoldsNoPressureAtTheSurface) {
  const Field field = solve_at(pekeris(), 0.0, 500.0, {});
  EXPECT_EQ(field.pressure.abs().maxCoeff(), 0.0);
}

}  // namespace
}  // namespace earshot::pe
