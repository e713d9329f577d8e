#include "policy/own_search/own_search.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::own_search {
namespace {

TEST(OwnSearch, AllowsAThirdMoreDepthWhereTheSeaFloorDoes) {
  EXPECT_EQ(max_depth_m({.depth_m = 300.0, .sea_floor_m = 3000.0}), 400.0);  // as search.toml has it
  EXPECT_EQ(max_depth_m({.depth_m = 300.0, .sea_floor_m = 350.0}), 349.0);
  EXPECT_EQ(max_depth_m({.depth_m = 349.5, .sea_floor_m = 350.0}), 349.5);
}

TEST(OwnSearch, AllowsAFifthMoreTimeThanAllStepsTake) {
  EXPECT_EQ(max_time_s({.speed_mps = 2.0}, 1000.0, 100.0), 60'000.0);  // as search.toml has it
  EXPECT_EQ(max_time_s({.speed_mps = 0.5}, 1000.0, 100.0), 240'000.0);
}

TEST(OwnSearch, RefusesToSearchBelowTheSeaFloor) {
  EXPECT_NO_THROW(require_consistent({.depth_m = 99.0, .sea_floor_m = 100.0}));
  EXPECT_THROW(require_consistent({.depth_m = 100.0, .sea_floor_m = 100.0}), host::BadInput);
}

TEST(OwnSearch, NeedsAPolicyOfItsOwnWhereEitherSideIsAnother) {
  EXPECT_TRUE(is_of_shipped_size({}));
  EXPECT_FALSE(is_of_shipped_size({.area_north_m = 24'000.0}));
  EXPECT_FALSE(is_of_shipped_size({.area_east_m = 26'000.0}));
}

// Coates at 20 Hz: ships 40 - 44.17 + 78.06 = 73.89, wind 50 + 16.77 - 33.98 + 15.07 = 47.86; at 400 Hz: ships 40 - 10.35 + 22.00 = 51.65,
// wind 50 + 16.77 - 7.96 + 3.88 = 62.69, together 63.02; 10.9 dB less.
TEST(OwnSearch, TakesNoiseForTheFrequency) {
  EXPECT_EQ(noise_db({}), 90.0);
  EXPECT_EQ(noise_db({.frequency_hz = 400.0}), 79.0);
  EXPECT_EQ(noise_db({.frequency_hz = 400.0, .noise_db = 55.5}), 55.5);
}

}  // namespace
}  // namespace earshot::own_search
