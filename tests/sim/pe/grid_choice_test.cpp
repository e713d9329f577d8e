#include "sim/pe/grid_choice.hpp"
#include "tests/sim/pe/short_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::pe {
namespace {

ocean::Section ocean_with_floor(std::vector<std::pair<double, double>> floor) {
  return tests::section_of({.floor = std::move(floor),
                            .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                            .sediment = {{0.0, {{0.0, 1600.0, 1.8, 0.5}}}}});
}

TEST(GridChoice, StaysWithinTheErrorItIsAskedFor) {
  for (const double accuracy : {0.005, 0.02, 0.1}) {
    for (const double frequency : {10.0, 100.0}) {
      const auto choice = choose_grid(ocean_with_floor({{0.0, 1000.0}}), Hertz{frequency}, Meters{20'000.0}, Decibels{accuracy});
      EXPECT_LE(choice.predicted_error_db, 1.0001 * accuracy) << accuracy << ' ' << frequency;
    }
  }
}

TEST(GridChoice, OwnsUpToTheErrorOfASlopeThatNoGridTakesAway) {
  const ocean::Section slope = ocean_with_floor({{0.0, 1000.0}, {5'000.0, 500.0}});
  const auto finest = choose_grid(slope, Hertz{20.0}, Meters{5'000.0}, Decibels{0.001});
  EXPECT_GT(finest.predicted_error_db, 0.2 * 0.1 * std::log(2.0) * 0.95);  // 0.2 dB integral of slope^2 / depth, by hand; depth in the mean
  EXPECT_LT(finest.predicted_error_db, 0.2 * 0.1 * std::log(2.0) + 0.001);
}

TEST(GridChoice, ScalesWithTheWavelength) {
  const ocean::Section section = ocean_with_floor({{0.0, 1000.0}});
  const auto low = choose_grid(section, Hertz{10.0}, Meters{30'000.0}, Decibels{0.02});
  const auto high = choose_grid(section, Hertz{40.0}, Meters{7'500.0}, Decibels{0.02});  // as many wavelengths
  EXPECT_NEAR(low.depth_step / high.depth_step, 4.0, 1e-9);
  EXPECT_NEAR(low.range_step / high.range_step, 4.0, 1e-9);
}

TEST(GridChoice, ShortensTheStepOnASteeperSlope) {
  const auto step = [](double depth_m) {
    return choose_grid(ocean_with_floor({{0.0, 3000.0}, {20'000.0, depth_m}}), Hertz{20.0}, Meters{20'000.0}, Decibels{0.02}).range_step;
  };
  EXPECT_NEAR(step(2000.0) / step(1000.0), std::pow(2.0, 0.75), 1e-9);  // error ~ slope^1.5 step^2
  EXPECT_LT(step(1000.0), step(3000.0));
}

}  // namespace
}  // namespace earshot::pe
