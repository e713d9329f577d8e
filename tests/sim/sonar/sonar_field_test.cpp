#include "sim/sonar/sonar_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/ocean/file/environment_file.hpp"
#include "sim/ocean/section_along.hpp"
#include "tests/reference/transmission_loss.hpp"
#include "tests/sim/sonar/charted_ocean.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::sonar {
namespace {

ocean::Environment papers_ocean() {
  return ocean::load_environment(std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml");
}

TEST(TransmissionLoss, IsSixtyDecibelsForAThousandthOfThePressure) {
  EXPECT_NEAR(transmission_loss(1e-3 * 1e-3).value, 60.0, 1e-12);  // rounding
}

TEST(TransmissionLoss, IsCappedWhereThereIsNoPressure) {
  EXPECT_EQ(transmission_loss(0.0), kMaxTransmissionLoss);
}

TEST(SonarField, CurveFollowsTheReferenceOfThePapersOcean) {
  const SnrCurve curve = compute_snr_curve(papers_ocean(), Meters{300.0}, Meters{40'000.0});
  EXPECT_NEAR(curve.max_range().value, 40'000.0, 1e-6);
  reference::TransmissionLoss loss;
  const auto truth = reference::load("munk_20hz");
  for (const auto& [range_m, unused] : truth) {
    if (range_m <= 40'000) loss[range_m] = 190.0 - 90.0 - curve.at(Meters{static_cast<double>(range_m)}).value;
  }
  const auto audible = [](int, double tl) { return tl >= 110.0; };
  EXPECT_LT(reference::compare(loss, truth, 500, 25'000, audible).root_mean_square_db, 0.1);  // a fifth of the project's bar
  EXPECT_LT(reference::compare(loss, truth, 50, 500, audible).root_mean_square_db,
            0.5);  // asymptotic Hankel function: 1 / (8 k r) at 50 m is 3 percent
}

TEST(SonarField, HasNoCurveForAReceiverThatIsNotInTheWater) {
  ocean::Environment shallow = papers_ocean();
  shallow.name = "shallow";
  shallow.seabed.depth = Meters{250.0};
  try {
    (void)compute_snr_curve(shallow, Meters{300.0}, Meters{1'000.0});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(support::tells(error.what(), {"shallow", "300 m", "above", "250 m"}));
  }
  EXPECT_THROW((void)compute_snr_curve(shallow, Meters{250.0}, Meters{1'000.0}), std::invalid_argument);
  EXPECT_NO_THROW((void)compute_snr_curve(shallow, Meters{249.0}, Meters{1'000.0}));
}

TEST(SonarField, HasNoCurveWhereTheOceanDiffersFromBearingToBearing) {
  try {
    (void)compute_snr_curve(tests::charted_ocean(), Meters{300.0}, Meters{1'000.0});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(support::tells(error.what(), {"charted", "differs", "SNR", "not"}));
  }
}

TEST(SonarField, CurveIsSilentWhereTheReceiverWouldBeInTheSeaFloor) {
  ocean::Environment shoaling = papers_ocean();
  shoaling.sea_floor_stations = {{Meters{0.0}, Meters{1000.0}}, {Meters{2000.0}, Meters{200.0}}};
  const SnrCurve curve = compute_snr_curve(shoaling, Meters{500.0}, Meters{2'000.0});  // 500 m deep at 1250 m
  EXPECT_EQ(curve.range_step(), Meters{10.0});
  EXPECT_NEAR(curve.max_range().value, 2000.0, 1e-9);
  EXPECT_EQ(curve.at(Meters{1260.0}).value, 190.0 - 300.0 - 90.0);
  EXPECT_GT(curve.at(Meters{1240.0}).value, 0.0);
  EXPECT_EQ(curve.at(Meters{0.0}), curve.at(Meters{10.0}));
}

TEST(SonarField, SubtractsLossAndNoiseFromTheSourceLevel) {
  const RadialPlan plan{.source_depth = Meters{30.0},
                        .depth_m = {100.0, 300.0},
                        .range_step = Meters{12.5},
                        .ranges = 160,
                        .band = {Hertz{20.0}, Hertz{20.0}}};
  const ocean::Section section = ocean::section_along(papers_ocean(), {}, Radians{}, plan.max_range());
  const SonarField field = compute_sonar_field(papers_ocean(), section, plan);
  EXPECT_FALSE(field.unmeasured);
  ASSERT_EQ(field.transmission_loss_db.size(), 2 * field.range_m.size());
  EXPECT_NEAR(field.snr_db(50, 1), 100.0F - field.transmission_loss_db[2 * 50 + 1], 1e-5);  // float
  EXPECT_NEAR(field.range_m[50], 51.0 * field.range_m[0], 1e-9);
}

TEST(SonarField, KnowsWhatOfItsWaterWasNotMeasured) {
  const ocean::Environment charted = tests::charted_ocean();
  const RadialPlan plan{
      .source_depth = Meters{30.0}, .depth_m = {300.0}, .range_step = Meters{25.0}, .ranges = 40, .band = {Hertz{20.0}, Hertz{20.0}}};
  const SonarField field = compute_sonar_field(charted, ocean::section_along(charted, {}, Radians{}, plan.max_range()), plan);
  ASSERT_TRUE(field.unmeasured.has_value());
  EXPECT_EQ(field.unmeasured->data_end, Meters{1500.0});
  EXPECT_NEAR(field.unmeasured->sea_floor.value, 3000.0, 1e-6);
}

}  // namespace
}  // namespace earshot::sonar
