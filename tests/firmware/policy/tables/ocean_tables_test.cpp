#include "firmware/policy/tables/ocean_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/firmware/not_finite.hpp"
#include "tests/firmware/policy/tables/made_up_tables.hpp"

namespace earshot::policy {
namespace {

using tests::kInfinity;
using tests::kNan;

TEST(HalfDecibels, AreTheNearestAndTheLouderOfTwoAsNear) {
  EXPECT_EQ(to_half_db(10.0), 20);
  EXPECT_EQ(to_half_db(10.24), 20);
  EXPECT_EQ(to_half_db(10.25), 21);
  EXPECT_EQ(to_half_db(0.0), 0);
  EXPECT_EQ(to_half_db(-0.25), 0);
  EXPECT_EQ(to_half_db(-0.26), -1);
  EXPECT_EQ(to_half_db(-10.25), -20);
  EXPECT_EQ(to_half_db(-10.26), -21);
}

TEST(HalfDecibels, EndWhereAByteDoes) {
  for (const double loud : {63.5, 63.4, 80.0, 1e300, kInfinity}) EXPECT_EQ(to_half_db(loud), 127) << loud;
  for (const double faint : {-64.0, -63.9, -200.0, -1e300, -kInfinity, kNan}) EXPECT_EQ(to_half_db(faint), -128) << faint;
  EXPECT_EQ(to_half_db(-63.5), -127);
  EXPECT_EQ(to_half_db(63.0), 126);
}

TEST(HalfDecibels, AreOffByAQuarterOfADecibelAtMost) {
  OceanTable table;
  for (double snr_db = -64.0; snr_db <= 63.5; snr_db += 0.01) {
    table.snr_half_db[0] = to_half_db(snr_db);
    ASSERT_LE(std::abs(double{table.snr_db(0)} - snr_db), 0.25 + 1e-9) << snr_db;
  }
}

std::unique_ptr<OceanTables> tables() {
  return std::make_unique<OceanTables>(made_up_tables());
}

TEST(OceanTables, HaveAShapeThatFitsTheirMemory) {
  const auto t = tables();
  EXPECT_TRUE(has_valid_shape(*t));
  EXPECT_TRUE(has_valid_numbers(*t));
  t->range_count = 0;
  EXPECT_FALSE(has_valid_shape(*t));
  t->range_count = config::kMaxTableRanges;
  EXPECT_TRUE(has_valid_shape(*t));
  t->range_count = config::kMaxTableRanges + 1;
  EXPECT_FALSE(has_valid_shape(*t));
}

TEST(OceanTables, AreOneAtLeastAndEachHasAName) {
  const auto t = tables();
  t->tables[1].name.clear();
  EXPECT_FALSE(has_valid_shape(*t));
  t->tables.clear();
  EXPECT_FALSE(has_valid_shape(*t));
}

/// Every number at its limits, as its docstring says them, and a little beyond.
TEST(OceanTables, LetPassWhatIsInItsRangeAndNothingBeyond) {
  const auto is_valid_with = [](auto set, double value) {
    const auto t = tables();
    set(*t, value);
    return has_valid_numbers(*t);
  };
  const auto expect_range = [&is_valid_with](const char* what, double least, double most, auto set) {
    EXPECT_TRUE(is_valid_with(set, least)) << what;
    EXPECT_TRUE(is_valid_with(set, most)) << what;
    EXPECT_FALSE(is_valid_with(set, std::nextafter(static_cast<float>(least), -1e9F))) << what;
    EXPECT_FALSE(is_valid_with(set, std::nextafter(static_cast<float>(most), 1e9F))) << what;
    EXPECT_FALSE(is_valid_with(set, kNan)) << what;
  };
  constexpr double kLeast = 5e-324;  // anything above zero
  const auto expect_depth = [&](const char* what, double most, auto set) {
    EXPECT_TRUE(is_valid_with(set, kLeast)) << what;
    EXPECT_FALSE(is_valid_with(set, 0.0)) << what;
    EXPECT_TRUE(is_valid_with(set, most)) << what;
    EXPECT_FALSE(is_valid_with(set, most + 0.001)) << what;
    EXPECT_FALSE(is_valid_with(set, kNan)) << what;
  };
  expect_range("frequency", 1.0, 1e4, [](OceanTables& t, double x) { t.frequency = Hertz{x}; });
  expect_range("range step", 1.0, 1e4, [](OceanTables& t, double x) { t.range_step = Meters{x}; });
  expect_range("prior", double{1e-6F}, 1e6, [](OceanTables& t, double x) { t.tables[1].prior = static_cast<float>(x); });
  expect_range("sea floor of a table", 200.0, 4000.0, [](OceanTables& t, double x) { t.tables[0].sea_depth_m = static_cast<float>(x); });
  expect_range("deepest sea floor", 3000.0, 12e3, [](OceanTables& t, double x) { t.sea_depth.most = Meters{x}; });
  expect_depth("shallowest sea floor", 200.0, [](OceanTables& t, double x) { t.sea_depth.least = Meters{x}; });
  expect_depth("receiver", 12e3, [](OceanTables& t, double x) { t.receiver_depth = Meters{x}; });
  expect_depth("shallowest source", 50.0, [](OceanTables& t, double x) { t.source_depth.least = Meters{x}; });
  expect_range("deepest source", 10.0, 12e3, [](OceanTables& t, double x) { t.source_depth.most = Meters{x}; });
}

TEST(OceanTables, ReachTheirLastRange) {
  EXPECT_EQ(reach(*tables()), Meters{200.0});
}

/// Tables of 20 Hz at 300 m, which reach 35.4 km.
Coverage coverage_of(SearchedSound sound) {
  const auto t = tables();
  t->range_count = 355;
  return coverage(*t, sound);
}
constexpr SearchedSound kUsual{.vehicle_depth = Meters{300.0}, .frequency = Hertz{20.0}, .furthest = Meters{35'355.0}};

TEST(Coverage, IsOfATenthOfTheDepthUpAndDown) {
  const auto at = [](double depth_m) {
    SearchedSound sound = kUsual;
    sound.vehicle_depth = Meters{depth_m};
    return coverage_of(sound);
  };
  for (const double depth_m : {300.0, 270.001, 329.999}) EXPECT_EQ(at(depth_m), Coverage::kCovered) << depth_m;
  for (const double depth_m : {269.999, 330.001, 0.0, kNan}) EXPECT_EQ(at(depth_m), Coverage::kAnotherDepth) << depth_m;
}

TEST(Coverage, IsOfATwentiethOfTheFrequencyUpAndDown) {
  const auto at = [](double frequency_hz) {
    SearchedSound sound = kUsual;
    sound.frequency = Hertz{frequency_hz};
    return coverage_of(sound);
  };
  for (const double frequency_hz : {20.0, 19.0001, 20.9999}) EXPECT_EQ(at(frequency_hz), Coverage::kCovered) << frequency_hz;
  for (const double frequency_hz : {18.9999, 21.0001, 0.0, kNan}) EXPECT_EQ(at(frequency_hz), Coverage::kAnotherFrequency) << frequency_hz;
}

TEST(Coverage, EndsWithTheLastRange) {
  const auto to = [](double furthest_m) {
    SearchedSound sound = kUsual;
    sound.furthest = Meters{furthest_m};
    return coverage_of(sound);
  };
  for (const double furthest_m : {0.0, 35'400.0}) EXPECT_EQ(to(furthest_m), Coverage::kCovered) << furthest_m;
  for (const double furthest_m : {35'400.1, kInfinity, kNan}) EXPECT_EQ(to(furthest_m), Coverage::kOutOfReach) << furthest_m;
}

TEST(AreUsable, AreTablesThatCoverTheSoundWithNumbersThatCanBe) {
  const auto usable_after = [](const auto& damage, SearchedSound sound = kUsual) {
    const auto t = tables();
    t->range_count = 355;
    damage(*t, sound);
    return are_usable(*t, sound);
  };
  EXPECT_TRUE(usable_after([](OceanTables&, SearchedSound&) {}));
  // Each of these alone.
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.tables.clear(); }));
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.range_count = 0; }));
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.range_step = Meters{kNan}; }));
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.source_depth.most = Meters{kNan}; }));
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.receiver_depth = Meters{kNan}; }));
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.frequency = Hertz{kNan}; }));
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.tables[1].prior = static_cast<float>(kNan); }));
  EXPECT_FALSE(usable_after([](OceanTables& t, SearchedSound&) { t.tables[1].sea_depth_m = static_cast<float>(kNan); }));
  EXPECT_FALSE(usable_after([](OceanTables&, SearchedSound& sound) { sound.vehicle_depth = Meters{kNan}; }));
  EXPECT_FALSE(usable_after([](OceanTables&, SearchedSound& sound) { sound.frequency = Hertz{kNan}; }));
  EXPECT_FALSE(usable_after([](OceanTables&, SearchedSound& sound) { sound.furthest = Meters{kNan}; }));
  EXPECT_FALSE(usable_after([](OceanTables&, SearchedSound& sound) { sound.furthest = Meters{35'401.0}; }));
}

/// The level of a dipole near the surface goes as 20 log10 (z_r f^2): what the tolerances allow is less than the narrowest spread, 1 dB.
TEST(Coverage, AllowsLessThanADecibelWhereTheSurfaceDecidesTheLevel) {
  EXPECT_LT(20.0 * std::log10(1.0 + kDepthTolerance), 1.0);
  EXPECT_LT(-20.0 * std::log10(1.0 - kDepthTolerance), 1.0);
  EXPECT_LT(40.0 * std::log10(1.0 + kFrequencyTolerance), 1.0);
  EXPECT_LT(-40.0 * std::log10(1.0 - kFrequencyTolerance), 1.0);
}

}  // namespace
}  // namespace earshot::policy
