#include "sim/sonar/model_files/tl_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace earshot::sonar::model_files {
namespace {

TEST(GridFile, HasARecordForEachRangeBehindTheNumberOfDepths) {
  const support::TemporaryFolder folder;
  const SonarField field{.range_m = {10.0, 20.0},
                         .depth_m = {1.0, 2.0, 3.0},
                         .source_level = {},
                         .noise_level = {},
                         .transmission_loss_db = {20.5F, 21.0F, 22.0F, 30.0F, 31.0F, std::nanf("")}};
  write_tl_grid(folder / "tl.grid", field);
  std::ifstream stream(folder / "tl.grid", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  ASSERT_EQ(bytes.size(), 12U + 2U * 20U);
  const auto word = [&bytes](std::size_t i) {
    std::int32_t value = 0;
    std::memcpy(&value, bytes.data() + 4 * i, sizeof(value));
    return value;
  };
  const auto number = [&bytes](std::size_t i) {
    float value = 0.0F;
    std::memcpy(&value, bytes.data() + 4 * i, sizeof(value));
    return value;
  };
  EXPECT_EQ((std::vector{word(0), word(1), word(2)}), (std::vector{4, 3, 4}));
  EXPECT_EQ((std::vector{word(3), word(7), word(8), word(12)}), (std::vector{12, 12, 12, 12}));
  EXPECT_EQ(number(4), 20.5F);
  EXPECT_EQ(number(6), 22.0F);
  EXPECT_EQ(number(9), 30.0F);
  EXPECT_TRUE(std::isnan(number(11)));
}

}  // namespace
}  // namespace earshot::sonar::model_files
