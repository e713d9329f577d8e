#include "sim/sonar/radial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/grid_check.hpp"

namespace earshot::sonar {
namespace {

ocean::Environment papers_ocean() {
  return ocean::load_environment(std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml");
}

RadialPlan plan(double source_depth_m, std::vector<double> depth_m, ocean::Band band = {Hertz{20.0}, Hertz{20.0}}) {
  return {.source_depth = Meters{source_depth_m}, .depth_m = std::move(depth_m), .range_step = Meters{25.0}, .ranges = 400, .band = band};
}

struct Loss {
  std::vector<float> db;
  std::vector<float> sea_floor_m;
};

Loss loss_of(const ocean::Environment& environment, const RadialPlan& radial) {
  Loss loss{.db = std::vector<float>(radial.ranges * radial.depth_m.size()), .sea_floor_m = std::vector<float>(radial.ranges)};
  compute_radial(environment, {}, Radians{}, radial, {.transmission_loss_db = loss.db, .sea_floor_depth_m = loss.sea_floor_m});
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

TEST(Radial, RefusesASourceBelowTheSeaFloor) {
  EXPECT_THROW(loss_of(papers_ocean(), plan(3100.0, {300.0})), std::invalid_argument);
}

TEST(GridCheck, FindsTheAutomaticGridAsGoodAsItPromises) {
  const GridCheck check = check_grid(papers_ocean(), {}, Radians{}, plan(30.0, {300.0}));
  EXPECT_LT(check.mean_db, 0.05);  // promised are 0.02 dB without the interference minima, which count here
  EXPECT_GT(check.mean_db, 0.0);
  EXPECT_GE(check.max_db, check.mean_db);
}

TEST(GridCheck, FindsACoarseGridBad) {
  RadialPlan coarse = plan(30.0, {300.0});
  coarse.options.depth_step = Meters{18.0};  // 4 points to a wavelength
  EXPECT_GT(check_grid(papers_ocean(), {}, Radians{}, coarse).mean_db, 0.2);
}

TEST(GridCheck, SeesAnAbsorberThatIsTooThinForTheSeabed) {
  auto silt = papers_ocean();
  silt.water = ocean::TabulatedProfile{{0.0}, {1500.0}};
  silt.seabed = {.depth = Meters{500.0}, .layers = silt.seabed.layers};
  silt.seabed.layers.front().sound_speed = MetersPerSecond{1500.0};
  silt.seabed.layers.front().attenuation_db_per_wavelength = 0.02;
  RadialPlan thin = plan(100.0, {200.0});
  EXPECT_LT(check_grid(silt, {}, Radians{}, thin).mean_db, 0.02);
  thin.options.absorber_wavelengths = 2.0;
  EXPECT_GT(check_grid(silt, {}, Radians{}, thin).mean_db, 0.05);
}

TEST(GridCheck, HalvesAStepThatIsShorterThanARowToo) {
  RadialPlan steep = plan(30.0, {300.0});
  steep.options.range_step = Meters{5.0};
  const GridCheck check = check_grid(papers_ocean(), {}, Radians{}, steep);
  EXPECT_EQ(check.range_step.value, 5.0);
  EXPECT_LT(check.mean_db, 0.1);  // 2000 steps and 4000: the propagator's error adds up
}

}  // namespace
}  // namespace earshot::sonar
