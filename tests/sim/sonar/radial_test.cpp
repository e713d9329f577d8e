#include "sim/sonar/radial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/ocean/file/environment_file.hpp"
#include "sim/ocean/section_along.hpp"
#include "sim/sonar/grid_check.hpp"

namespace earshot::sonar {
namespace {

ocean::Environment papers_ocean() {
  return ocean::load_environment(std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml");
}

RadialPlan plan(double source_depth_m, std::vector<double> depth_m, ocean::Band band = {Hertz{20.0}, Hertz{20.0}}) {
  return {.source_depth = Meters{source_depth_m}, .depth_m = std::move(depth_m), .range_step = Meters{25.0}, .ranges = 400, .band = band};
}

/// To the north of the origin.
ocean::Section section_of(const ocean::Environment& environment) {
  return ocean::section_along(environment, {}, Radians{}, Meters{10'000.0});
}

GridCheck check_grid(const ocean::Environment& environment, const RadialPlan& radial, const pe::Progress& progress = {}) {
  return check_grid(section_of(environment), environment.name, radial, progress);
}

struct Loss {
  std::vector<float> db;
  std::vector<float> sea_floor_m;
};

Loss loss_of(const ocean::Environment& environment, const RadialPlan& radial) {
  Loss loss{.db = std::vector<float>(radial.ranges * radial.depth_m.size()), .sea_floor_m = std::vector<float>(radial.ranges)};
  compute_radial(section_of(environment), environment.name, radial,
                 {.transmission_loss_db = loss.db, .sea_floor_depth_m = loss.sea_floor_m});
  return loss;
}

TEST(Radial, TakesTheMiddlesOfTheEqualPartsOfABand) {
  EXPECT_EQ(frequencies_hz({Hertz{15.0}, Hertz{30.0}, 3}), (std::vector<double>{17.5, 22.5, 27.5}));
  EXPECT_EQ(frequencies_hz({Hertz{20.0}, Hertz{20.0}, 3}), (std::vector<double>{20.0}));
}

TEST(Radial, AddsTheIntensitiesOfABandAndNotItsPressures) {
  const auto environment = papers_ocean();
  const std::vector<float> low = loss_of(environment, plan(30.0, {300.0}, {Hertz{17.5}, Hertz{17.5}})).db;
  const std::vector<float> high = loss_of(environment, plan(30.0, {300.0}, {Hertz{22.5}, Hertz{22.5}})).db;
  const std::vector<float> band = loss_of(environment, plan(30.0, {300.0}, {Hertz{15.0}, Hertz{25.0}, 2})).db;
  for (std::size_t i = 0; i < band.size(); ++i) {
    const double mean = 0.5 * (std::pow(10.0, -0.1 * static_cast<double>(low[i])) + std::pow(10.0, -0.1 * static_cast<double>(high[i])));
    ASSERT_NEAR(band[i], -10.0 * std::log10(mean), 1e-4) << i;  // float
  }
}

TEST(Radial, IsReciprocalBetweenSourceAndReceiverDepth) {
  const auto environment = papers_ocean();
  const std::vector<float> down = loss_of(environment, plan(30.0, {300.0})).db;
  const std::vector<float> up = loss_of(environment, plan(300.0, {30.0})).db;
  double mean = 0.0;
  for (std::size_t i = 40; i < down.size(); ++i) mean += static_cast<double>(std::abs(down[i] - up[i])) / static_cast<double>(down.size());
  EXPECT_LT(mean, 0.02);  // the accuracy asked of the solver by default
}

TEST(Radial, HasNoLossBelowTheSeaFloorNorBeyondTheShore) {
  auto environment = papers_ocean();
  environment.sea_floor_stations = {{Meters{0.0}, Meters{1000.0}}, {Meters{5000.0}, Meters{0.0}}};
  const Loss loss = loss_of(environment, plan(30.0, {100.0, 600.0, 2000.0}));
  for (std::size_t i = 0; i < 400; ++i) {
    const double floor_m = std::max(0.0, 1000.0 - 0.2 * 25.0 * static_cast<double>(i + 1));
    ASSERT_NEAR(loss.sea_floor_m[i], floor_m, 1e-3);  // float
    ASSERT_EQ(std::isnan(loss.db[3 * i]), floor_m < 100.0 - 1e-9) << i;
    ASSERT_EQ(std::isnan(loss.db[3 * i + 1]), floor_m < 600.0 - 1e-9) << i;
    ASSERT_TRUE(std::isnan(loss.db[3 * i + 2])) << i;  // nowhere
  }
}

TEST(Radial, KeepsItsDepthsApartInWhateverOrder) {
  RadialPlan radial = plan(30.0, {100.0, 300.0});
  radial.ranges = 4;
  const std::vector<float> both = loss_of(papers_ocean(), radial).db;
  radial.depth_m = {5000.0, 300.0, 4000.0, 100.0};  // two of them in the sea floor
  const std::vector<float> four = loss_of(papers_ocean(), radial).db;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(std::isnan(four[4 * i]) && std::isnan(four[4 * i + 2]));
    EXPECT_EQ(four[4 * i + 1], both[2 * i + 1]);
    EXPECT_EQ(four[4 * i + 3], both[2 * i]);
  }
}

TEST(Radial, HearsAHydrophoneThatLiesOnTheSeaFloor) {
  RadialPlan to_the_floor = plan(30.0, {3000.0});
  to_the_floor.ranges = 4;
  for (const float loss_db : loss_of(papers_ocean(), to_the_floor).db) EXPECT_FALSE(std::isnan(loss_db));
}

TEST(Radial, HasNoLossAndNoMarchWhereNoReceiverIsInTheWater) {
  auto environment = papers_ocean();
  const auto expect_silence = [&](const RadialPlan& radial) {
    std::vector<float> loss(radial.ranges * radial.depth_m.size());
    std::vector<float> floor(radial.ranges);
    bool marched = false;
    compute_radial(section_of(environment), environment.name, radial, {.transmission_loss_db = loss, .sea_floor_depth_m = floor},
                   [&](double) { marched = true; });
    for (const float loss_db : loss) EXPECT_TRUE(std::isnan(loss_db));
    EXPECT_FALSE(marched);
  };
  expect_silence(plan(30.0, {3001.0, 4000.0}));
  environment.sea_floor_stations = {{Meters{0.0}, Meters{1000.0}}, {Meters{20.0}, Meters{0.0}}};  // the shore lies before the first 25 m
  expect_silence(plan(1.0, {0.0, 10.0}));
}

TEST(Radial, SaysHowMuchOfAllItsFrequenciesIsDone) {
  RadialPlan two_frequencies = plan(30.0, {300.0}, {Hertz{15.0}, Hertz{25.0}, 2});
  std::vector<float> loss(two_frequencies.ranges);
  std::vector<float> floor(two_frequencies.ranges);
  std::vector<double> done;
  compute_radial(section_of(papers_ocean()), "", two_frequencies, {.transmission_loss_db = loss, .sea_floor_depth_m = floor},
                 [&](double share) { done.push_back(share); });
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_EQ(std::count(done.begin(), done.end(), 0.5), 1);  // the end of the first of two
  ASSERT_FALSE(done.empty());
  EXPECT_EQ(done.back(), 1.0);
}

TEST(Radial, KnowsItsDeepestSeaFloorAsFarAsItGoes) {
  auto environment = papers_ocean();
  environment.sea_floor_stations = {{Meters{0.0}, Meters{1000.0}}, {Meters{4000.0}, Meters{1500.0}}, {Meters{8000.0}, Meters{800.0}}};
  const auto deepest = [&](double range_m) { return deepest_sea_floor(section_of(environment), Meters{range_m}).value; };
  EXPECT_EQ(deepest(2000.0), 1250.0);
  EXPECT_EQ(deepest(4000.0), 1500.0);
  EXPECT_EQ(deepest(8000.0), 1500.0);
  environment.sea_floor_stations = {{Meters{0.0}, Meters{1000.0}}, {Meters{4000.0}, Meters{200.0}}};
  EXPECT_EQ(deepest(2000.0), 1000.0);
}

TEST(Radial, KnowsAShoreThatLiesBeforeItsFirstRange) {
  auto environment = papers_ocean();
  EXPECT_FALSE(shore_before(section_of(environment), Meters{25.0}));
  environment.sea_floor_stations = {{Meters{0.0}, Meters{1000.0}}, {Meters{20.0}, Meters{0.0}}};
  EXPECT_EQ(shore_before(section_of(environment), Meters{25.0}), Meters{20.0});
  EXPECT_FALSE(shore_before(section_of(environment), Meters{20.0}));
  EXPECT_FALSE(shore_before(section_of(environment), Meters{10.0}));
}

TEST(Radial, RefusesASourceBelowTheSeaFloor) {
  EXPECT_THROW(loss_of(papers_ocean(), plan(3100.0, {300.0})), std::invalid_argument);
}

// The solver against itself on a finer grid, which tells nothing of what both leave out: the tests of sim/pe do.
TEST(GridCheck, FindsTheAutomaticGridAsGoodAsItPromises) {
  const GridCheck check = check_grid(papers_ocean(), plan(30.0, {300.0}));
  EXPECT_LT(check.mean_db, 0.05);  // promised are 0.02 dB without the interference minima, which count here
  EXPECT_GT(check.mean_db, 0.0);
  EXPECT_GE(check.max_db, check.mean_db);
}

TEST(GridCheck, IsTheChangeFromAGridToOneOfHalfItsSteps) {
  RadialPlan given = plan(30.0, {50.0, 300.0, 1000.0});
  given.ranges = 40;
  given.options = {.depth_step = Meters{18.0}, .range_step = Meters{25.0}, .terms = 8, .absorber_wavelengths = 5.0};
  RadialPlan halved = given;
  halved.range_step = Meters{12.5};
  halved.ranges = 80;
  halved.options = {.depth_step = Meters{9.0}, .range_step = Meters{12.5}, .terms = 8, .absorber_wavelengths = 15.0};
  const std::vector<float> before = loss_of(papers_ocean(), given).db;
  const std::vector<float> after = loss_of(papers_ocean(), halved).db;
  double sum = 0.0;
  double largest = 0.0;
  Meters range;
  Meters depth;
  for (int range_m = 100; range_m <= 1000; range_m += 25) {  // 75 m is a wavelength
    for (std::size_t j = 0; j < 3; ++j) {
      const auto row = static_cast<std::size_t>(range_m / 25) - 1;
      const auto row_of_halved = static_cast<std::size_t>(2 * range_m / 25) - 1;
      const double change = std::abs(double{after[3 * row_of_halved + j]} - double{before[3 * row + j]});
      sum += change;
      if (change <= largest) continue;
      largest = change;
      range = Meters{static_cast<double>(range_m)};
      depth = Meters{given.depth_m[j]};
    }
  }
  const GridCheck check = check_grid(papers_ocean(), given);
  EXPECT_EQ(check.max_db, largest);
  EXPECT_EQ(check.range_of_max, range);
  EXPECT_EQ(check.depth_of_max, depth);
  EXPECT_NEAR(check.mean_db, sum / (37.0 * 3.0), 1e-9);  // rounding
  EXPECT_EQ(check.depth_step, Meters{18.0});
  EXPECT_EQ(check.range_step, Meters{25.0});
}

TEST(GridCheck, KeepsTheTermsThatWereAskedFor) {
  RadialPlan few = plan(30.0, {300.0});
  few.options.terms = 2;  // too few for the steps that it would choose
  EXPECT_THROW((void)check_grid(papers_ocean(), few), std::invalid_argument);
}

TEST(GridCheck, CountsTheCoarseMarchAsAFifthOfItsWork) {
  RadialPlan brief = plan(30.0, {300.0});
  brief.ranges = 40;
  std::vector<double> done;
  const GridCheck check = check_grid(papers_ocean(), brief, [&](double share) { done.push_back(share); });
  EXPECT_LT(check.max_db, 1.0);
  EXPECT_GT(check.range_of_max, Meters{75.0});  // a small change has its place too
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_EQ(std::count(done.begin(), done.end(), 0.2), 1);
  ASSERT_FALSE(done.empty());
  EXPECT_EQ(done.back(), 1.0);
}

TEST(GridCheck, FindsACoarseGridBad) {
  RadialPlan coarse = plan(30.0, {300.0});
  coarse.options.depth_step = Meters{18.0};  // 4 points to a wavelength
  EXPECT_GT(check_grid(papers_ocean(), coarse).mean_db, 0.2);
}

TEST(GridCheck, SeesAnAbsorberThatIsTooThinForTheSeabed) {
  auto silt = papers_ocean();
  silt.water = ocean::TabulatedProfile{{0.0}, {1500.0}};
  silt.seabed = {.depth = Meters{500.0}, .layers = silt.seabed.layers};
  silt.seabed.layers.front().sound_speed = MetersPerSecond{1500.0};
  silt.seabed.layers.front().attenuation_db_per_wavelength = 0.02;
  RadialPlan thin = plan(100.0, {200.0});
  EXPECT_LT(check_grid(silt, thin).mean_db, 0.02);
  thin.options.absorber_wavelengths = 2.0;
  EXPECT_GT(check_grid(silt, thin).mean_db, 0.05);
}

TEST(GridCheck, HalvesAStepThatIsShorterThanARowToo) {
  RadialPlan steep = plan(30.0, {300.0});
  steep.options.range_step = Meters{5.0};
  const GridCheck check = check_grid(papers_ocean(), steep);
  EXPECT_EQ(check.range_step.value, 5.0);
  EXPECT_LT(check.mean_db, 0.1);  // 2000 steps and 4000: the propagator's error adds up
}

}  // namespace
}  // namespace earshot::sonar
