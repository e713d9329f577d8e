#include "firmware/host/transport/can/filter.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace earshot::host {
namespace {

// By hand: bit 31 says extended, bit 30 remote; a broadcast group (PDU2) stands in bits 8..25, of an addressed one (PDU1) 8..15 are free.
constexpr CanFilter kVesselHeading{.identifier = 0x81F11200, .mask = 0xC3FFFF00};  // 127250 = 0x1F112
constexpr CanFilter kSpeedAndDepth{.identifier = 0x80FF0A00, .mask = 0xC3FFFF00};  // 65290 = 0x0FF0A
constexpr CanFilter kRequest{.identifier = 0x80EA0000, .mask = 0xC3FF0000};        // 59904 = 0x0EA00
constexpr CanFilter kRequestOfUs{.identifier = 0x80EA4000, .mask = 0xC3FFFF00};    // to 0x40
constexpr CanFilter kRequestOfEveryone{.identifier = 0x80EAFF00, .mask = 0xC3FFFF00};
constexpr CanFilter kFastAddressed{.identifier = 0x81EF0000, .mask = 0xC3FF0000};  // 126720 = 0x1EF00

std::vector<CanFilter> list(const CanFilters& filters) {
  return {filters.begin(), filters.end()};
}

TEST(CanFilter, LeavesSourcePriorityAndTheDestinationOfAnAddressedGroupFree) {
  CanFilters filters;
  ASSERT_EQ(filters_for(std::array<std::uint32_t, 4>{127250, 65290, 59904, 126720}, filters), Status::kOk);
  EXPECT_EQ(list(filters), (std::vector{kVesselHeading, kSpeedAndDepth, kRequest, kFastAddressed}));
}

TEST(CanFilter, TakesAnAddressedGroupThatIsForUsOrForEveryone) {
  CanFilters filters;
  ASSERT_EQ(filters_for(std::array<std::uint32_t, 1>{127250}, std::array<std::uint32_t, 1>{59904}, 0x40, filters), Status::kOk);
  EXPECT_EQ(list(filters), (std::vector{kVesselHeading, kRequestOfUs, kRequestOfEveryone}));
}

TEST(CanFilter, NamesAGroupOnceHoweverOftenItIsAskedFor) {
  CanFilters filters;
  ASSERT_EQ(filters_for(std::array<std::uint32_t, 3>{127250, 65290, 127250}, filters), Status::kOk);
  EXPECT_EQ(list(filters), (std::vector{kVesselHeading, kSpeedAndDepth}));
}

TEST(CanFilter, RefusesWhatIsNoGroupAndLeavesNothing) {
  CanFilters filters;
  EXPECT_EQ(filters_for(std::array<std::uint32_t, 2>{127250, 0x40000}, filters), Status::kOutOfRange);
  EXPECT_TRUE(filters.empty());
  EXPECT_EQ(filters_for(std::array<std::uint32_t, 1>{0xEA01}, filters), Status::kOutOfRange) << "a destination is no part of a group";
  EXPECT_EQ(filters_for({}, std::array<std::uint32_t, 1>{127250}, 0x40, filters), Status::kOutOfRange) << "goes to everyone always";
}

TEST(CanFilter, SaysWhenThereAreMoreGroupsThanEntries) {
  std::vector<std::uint32_t> groups;
  for (std::uint32_t i = 0; i <= config::kCanFilters; ++i) groups.push_back(0xFF00 + i);
  CanFilters filters;
  EXPECT_EQ(filters_for(groups, filters), Status::kFull);
  EXPECT_TRUE(filters.empty());
  groups.pop_back();
  EXPECT_EQ(filters_for(groups, filters), Status::kOk);
}

}  // namespace
}  // namespace earshot::host
