#include "policy/report/map/snr_surface.hpp"

#include <gtest/gtest.h>

namespace earshot::report {
namespace {

constexpr Rectangle kArea{.south_west = {}, .north_east = {Meters{24'000.0}, Meters{24'000.0}}};
constexpr NorthEast kInTheMiddle{Meters{12'000.0}, Meters{12'000.0}};

TEST(SnrSurface, ShowsTheMeanIntensityOfInterferenceFinerThanACell) {
  // Minima of 0 dB and maxima of 20 dB every 10 m, straight lines of intensity between them: 1, 100, 1, 100... with a mean of 50.5.
  std::vector<float> snr_db;
  for (int i = 0; i <= 2'000; ++i) snr_db.push_back(i % 2 == 0 ? 0.0F : 20.0F);
  const sonar::SnrCurve curve(Meters{10.0}, snr_db);
  const std::vector<double> surface = snr_surface(curve, kInTheMiddle, kArea, 100);
  ASSERT_EQ(surface.size(), 10'000U);
  // A cell of 240 m covers 12 whole periods wherever it begins; sampled at their centres, cells would lie anywhere from 0 to 20 dB.
  constexpr double kRounding = 1e-6;
  for (const double snr : surface) EXPECT_NEAR(snr, 17.0329138, kRounding);  // 10 log10(50.5)
}

TEST(SnrSurface, OfASmoothFieldIsTheFieldFromSouthWestToNorthEastInRows) {
  std::vector<float> snr_db;
  for (int i = 0; i <= 40; ++i) snr_db.push_back(static_cast<float>(40 - i));
  const sonar::SnrCurve curve(Meters{1'000.0}, snr_db);
  const std::vector<double> surface = snr_surface(curve, {}, kArea, 24);
  // The first cell's centre lies 707 m from the corner, the last of its row 23.505 km, the north-eastern one 33.234 km. Within a cell of
  // 1 km the level falls by 1 dB: its mean intensity lies some hundredths of a dB over the level at its centre.
  constexpr double kCurvature = 0.05;
  EXPECT_NEAR(surface.front(), 40.0 - 0.707, kCurvature);
  EXPECT_NEAR(surface[23], 40.0 - 23.505, kCurvature);
  EXPECT_NEAR(surface.back(), 40.0 - 33.234, kCurvature);
}

TEST(SnrSurface, BeyondTheCurvesEndIsWhatItIsThere) {
  const sonar::SnrCurve curve(Meters{1'000.0}, {30.0F, 20.0F, 6.0F});
  EXPECT_NEAR(snr_surface(curve, {}, kArea, 10).back(), 6.0, 1e-5);  // samples are floats
}

}  // namespace
}  // namespace earshot::report
