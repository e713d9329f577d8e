#include "sim/ocean/file/profile_csv.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <variant>

#include "tests/sim/ocean/charts/chart_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::ocean {
namespace {

constexpr Radians kEquator{0.0};

class WaterProfile : public testing::Test {
 protected:
  std::vector<WaterStation> read(const std::string& text, SoundSpeedFormula formula = SoundSpeedFormula::kUnesco) {
    std::ofstream(folder_ / "w.csv") << text;
    return read_profile_csv(folder_ / "w.csv", kEquator, formula);
  }
  void expect_complaint(const std::string& text, const std::string& part) {
    const std::string complaint = tests::complaint_of([&] { (void)read(text); });
    EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
  }
  support::TemporaryFolder folder_;
};

TEST_F(WaterProfile, TurnsTemperatureAndSalinityIntoSoundSpeed) {
  const std::string cast = "depth_m,temperature_c,salinity_psu\n0,10,35\n1000,25,35\n";
  // seawater 3.3.5: 1489.8309 m/s at 10 degC, 35 psu, surface (rounded coefficients, 5 mm/s); Mackenzie's check value at 1000 m.
  EXPECT_NEAR(sound_speed(read(cast).front().profile, Meters{0.0}).value, 1489.831, 0.005);
  EXPECT_NEAR(sound_speed(read(cast, SoundSpeedFormula::kMackenzie).front().profile, Meters{1000.0}).value, 1550.744, 0.0005);
}

TEST_F(WaterProfile, HoldsAProfileForEachRange) {
  const auto stations = read("range_m,depth_m,sound_speed_mps\n0,0,1500\n0,100,1490\n5000,0,1510\n5000,50,1505\n5000,200,1500\n");
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_EQ(stations[1].range, Meters{5000.0});
  EXPECT_EQ(std::get<TabulatedProfile>(stations[1].profile).depth_m, (std::vector<double>{0.0, 50.0, 200.0}));
}

TEST_F(WaterProfile, RefusesGapsAndDisorder) {
  expect_complaint("depth_m,sound_speed_mps\n0,1500\n10,\n20,1490\n", "w.csv:3: sound_speed_mps = nothing: must be a finite number");
  expect_complaint("depth_m,sound_speed_mps\n0,1500\n20,1490\n10,1495\n", "w.csv:4: depth_m = 10: must be more than in the line before");
  expect_complaint("depth_m,sound_speed_mps\n5,1500\n20,1490\n", "w.csv:2: depth_m = 5: a profile must begin at 0");
  expect_complaint("range_m,depth_m,sound_speed_mps\n100,0,1500\n0,0,1490\n", "w.csv:3: range_m = 0: must not decrease");
  expect_complaint("depth_m,temperature_c\n0,10\n", "must have a column salinity_psu, has: depth_m, temperature_c");
  expect_complaint("depth_m,temperature_c,salinity_psu\n0,283,35\n",
                   "w.csv:2: temperature_c = 283: must be a finite number of at least -3 and at most 45");
  expect_complaint("depth_m,sound_speed_mps\n0,5000\n",
                   "w.csv:2: sound_speed_mps = 5000: must be a finite number of at least 1300 and at most 1700");
}

TEST_F(WaterProfile, HasRoomForTenThousandRanges) {
  std::string text = "range_m,depth_m,sound_speed_mps\n";
  for (int i = 0; i < 10'000; ++i) text += std::to_string(i) + ",0,1500\n" + std::to_string(i) + ",3000,1520\n";
  EXPECT_EQ(read(text).size(), 10'000U);
  expect_complaint(text + "10000,0,1500\n", "w.csv:20002: range_m = 10000: is one profile too many, there is room for 10000");
}

}  // namespace
}  // namespace earshot::ocean
