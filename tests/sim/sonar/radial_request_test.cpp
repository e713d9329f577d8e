#include "sim/sonar/radial_request.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"
#include "tests/sim/sonar/hilly_ocean.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::sonar {
namespace {

ocean::Environment ocean_of_depth(const std::string& depth_m) {
  return ocean::environment_of_text("text",
                                    "name = \"n\"\n[source]\nfrequency_hz = 50\nlevel_db_re_1upa_at_1m = 190\ndepth_m = 30\nnorth_m = 0\n"
                                    "east_m = 0\n[noise]\nlevel_db_re_1upa = 90\n[water]\nprofile = \"table\"\ndepth_m = [0, 5000]\n"
                                    "sound_speed_mps = [1500, 1500]\n[seabed]\ndepth_m = " +
                                        depth_m + "\n[[seabed.layers]]\nsound_speed_mps = 1600\n");
}

RadialRequest request_to(double max_range_m) {
  return {.max_range = Meters{max_range_m}, .band = {Hertz{50.0}, Hertz{50.0}}};
}

TEST(RadialRequest, HasDepthsOfTenMetresAndARowEverySixthOfAWavelength) {
  const RadialPlan plan = plan_radial(ocean_of_depth("1204"), Radians{}, request_to(1000.0)).plan;
  EXPECT_EQ(plan.range_step, Meters{5.0});  // 1500 m/s / 50 Hz / 6
  EXPECT_EQ(plan.ranges, 200U);
  EXPECT_EQ(plan.depth_m.size(), 121U);
  EXPECT_EQ(plan.depth_m.front(), 10.0);
  EXPECT_EQ(plan.depth_m[119], 1200.0);
  EXPECT_EQ(plan.depth_m.back(), 1204.0);
}

TEST(RadialRequest, HasAHundredDepthsInShallowWater) {
  const RadialPlan plan = plan_radial(ocean_of_depth("100"), Radians{}, request_to(1000.0)).plan;
  EXPECT_EQ(plan.depth_m.size(), 100U);
  EXPECT_EQ(plan.depth_m.front(), 1.0);
  EXPECT_EQ(plan.depth_m.back(), 100.0);
}

TEST(RadialRequest, IsRefusedByTheNameOfWhoAsked) {
  RadialRequest request = request_to(1000.0);
  request.depth_m = {50.0, 101.0};
  try {
    (void)plan_radial(ocean_of_depth("100"), Radians{}, request);
    FAIL() << "a receiver below the sea floor was taken";
  } catch (const BadRequest& bad) {
    EXPECT_EQ(bad.what_is_wrong(), BadRequest::What::kDepth);
    EXPECT_EQ(bad.value(), 101.0);
    EXPECT_EQ(bad.called("--depth"), "--depth = 101: must be from 0 m to the sea floor, at its deepest 100 m");
  }
}

TEST(RadialRequest, IsRefusedWithAStepLongerThanItsRangeAndEndsThereWithoutOne) {
  RadialRequest request = request_to(5.0);
  EXPECT_EQ(plan_ranges(request, Meters{18.0}).max_range().value, 5.0) << "a sixth of a wavelength of 20 Hz is 12.5 m";
  request.output_step = Meters{6.0};
  try {
    (void)plan_ranges(request, Meters{18.0});
    FAIL() << "a field of 5 m whose first range is 6 m was taken";
  } catch (const BadRequest& bad) {
    EXPECT_EQ(bad.what_is_wrong(), BadRequest::What::kOutputStep);
    EXPECT_EQ(bad.called("--output-step-m"), "--output-step-m = 6: must not be longer than the range of the field, 5 m");
  }
}

TEST(RadialRequest, IsRefusedWhereItHasMoreValuesThanAFieldMay) {
  RadialRequest request = request_to(1e6);
  request.output_step = Meters{0.01};
  try {
    (void)plan_radial(ocean_of_depth("100"), Radians{}, request);
    FAIL() << "10 000 000 000 values were taken";
  } catch (const BadRequest& bad) {
    EXPECT_EQ(bad.what_is_wrong(), BadRequest::What::kOutputStep);
  }
}

TEST(RadialRequest, GivesThePressureThatTheLossIsOf) {
  RadialRequest request = request_to(2000.0);
  request.depth_m = {20.0, 60.0};
  const ocean::Environment environment = ocean_of_depth("100");
  const PlannedRadial radial = plan_radial(environment, Radians{}, request);
  const SonarField field = compute_sonar_field(environment, radial.section, radial.plan, {}, Pressure::kKept);
  ASSERT_EQ(field.pressure.size(), field.transmission_loss_db.size());
  for (std::size_t i = 0; i < field.pressure.size(); ++i) {
    // A float of 60 dB has a digit of 4e-6 dB.
    EXPECT_NEAR(-20.0 * std::log10(std::abs(field.pressure[i])), static_cast<double>(field.transmission_loss_db[i]), 1e-5);
  }
  ASSERT_TRUE(field.grid.has_value());
  EXPECT_LE(field.grid->predicted_error_db, 0.02);
  EXPECT_GT(field.grid->predicted_error_db, 0.0);
  EXPECT_NEAR(field.grid->reference_wavenumber_per_m, 2.0 * 3.14159265 * 50.0 / 1500.0, 1e-3);
  EXPECT_TRUE(compute_sonar_field(environment, radial.section, radial.plan).pressure.empty());
}

TEST(RadialRequest, PredictsNoErrorOfAGridThatTheCallerChose) {
  RadialRequest request = request_to(1000.0);
  request.options.depth_step = Meters{0.5};
  const ocean::Environment environment = ocean_of_depth("100");
  const PlannedRadial radial = plan_radial(environment, Radians{}, request);
  const SonarField field = compute_sonar_field(environment, radial.section, radial.plan);
  ASSERT_TRUE(field.grid.has_value());
  EXPECT_TRUE(std::isnan(field.grid->predicted_error_db));
  EXPECT_LE(field.grid->depth_step, Meters{0.5});
}

RadialRequest fan_request() {
  return {.max_range = Meters{16'000.0}, .depth_m = {100.0}, .output_step = Meters{8000.0}, .band = {Hertz{20.0}, Hertz{20.0}}};
}

TEST(FanRequest, SaysHowManyBearingsMeetLandNearerThanTheFirstRange) {
  const support::TemporaryFolder folder;
  const auto hills = ocean::load_environment(tests::write_hilly_ocean(folder.path()));  // an island 7 km in the east
  const PlannedFan fan = plan_fan(hills, 4, fan_request());
  EXPECT_EQ(fan.plan.bearings, 4U);
  EXPECT_EQ(fan.plan.radial.ranges, 2U);
  ASSERT_TRUE(fan.land.has_value());
  EXPECT_EQ(*fan.land,
            "1 of 4 bearings (the first at 90 degrees) meet land nearer than the first range, 8000 m: there is no number on them");
  RadialRequest near = fan_request();
  near.output_step = Meters{1000.0};
  EXPECT_FALSE(plan_fan(hills, 4, near).land.has_value());
}

TEST(FanRequest, IsRefusedWhereNoBearingHasWaterAsFarAsTheFirstRange) {
  ocean::Environment beach = ocean_of_depth("200");
  beach.sea_floor_stations = {{.range = Meters{}, .depth = Meters{200.0}}, {.range = Meters{3000.0}, .depth = Meters{}}};
  try {
    (void)plan_fan(beach, 36, fan_request());
    FAIL() << "a fan without a number was taken";
  } catch (const BadRequest& bad) {
    EXPECT_EQ(bad.what_is_wrong(), BadRequest::What::kRadials);
    EXPECT_EQ(bad.called("--radials"),
              "--radials = 36: all of them meet land nearer than the first range, 8000 m: there is no number on them");
  }
}

}  // namespace
}  // namespace earshot::sonar
