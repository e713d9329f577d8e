#include "sim/netcdf/header.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace earshot::netcdf {
namespace {

const Header kChart{{"depth", {.dimensions = {}, .texts = {}}},
                    {"elevation",
                     {.dimensions = {{"lat", 3}, {"lon", 5'000'000'000}},
                      .texts = {{"units", "m"}, {"comment", ""}},
                      .packing_fault = "add_offset: must be one number"}}};

TEST(NetcdfHeader, IsTheSameInAnotherProcess) {
  const auto header = header_from(to_bytes(kChart));
  ASSERT_TRUE(header);
  ASSERT_EQ(header->size(), 2U);
  EXPECT_TRUE(header->at("depth").dimensions.empty());
  const Variable& elevation = header->at("elevation");
  ASSERT_EQ(elevation.dimensions.size(), 2U);
  EXPECT_EQ(elevation.dimensions[0].name, "lat");
  EXPECT_EQ(elevation.dimensions[1].length, 5'000'000'000U);
  EXPECT_EQ(elevation.texts, kChart.at("elevation").texts);
  EXPECT_EQ(elevation.packing_fault, "add_offset: must be one number");
  EXPECT_TRUE(header_from("")->empty());
}

/// A child that a damaged file has led astray may hand over anything.
TEST(NetcdfHeader, IsNoneOfBytesThatEndEarlyOrTellOfMoreThanThereIs) {
  const std::string bytes = to_bytes(kChart);
  const std::string first = to_bytes({*kChart.begin()});  // whole by itself
  for (std::size_t size = 1; size < bytes.size(); ++size)
    EXPECT_EQ(header_from(std::string_view(bytes).substr(0, size)).has_value(), size == first.size()) << size;
  for (std::size_t at = 0; at + sizeof(std::size_t) <= bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged.replace(at, sizeof(std::size_t), sizeof(std::size_t), '\xFF');
    (void)header_from(damaged);  // names and texts may be anything
  }
  std::string endless = bytes;
  endless.replace(0, sizeof(std::size_t), sizeof(std::size_t), '\xFF');
  EXPECT_FALSE(header_from(endless));
}

}  // namespace
}  // namespace earshot::netcdf
