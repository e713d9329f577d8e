#include "hil/nodes/membership.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

constexpr Nameplate kPlate{.model = "log", .device_class = 60, .device_function = 155, .preferred_address = 0x25, .unique_number = 4711};

TEST(Membership, ClaimsItsAddressWithItsName) {
  Membership membership(kPlate, {n2k::kSpeedPgn}, {});
  const Frames frames = run(membership, Time{}, Time{1});
  ASSERT_EQ(frames.size(), 1U);
  // 60928 = 0xEE00 at priority 6 to all. 4711 = 0x1267 in 21 bits, maker 2044 in 11: 0xFF801267; instance 0, function 155, class 60 (twice
  // that), marine industry and any address: 0xC0.
  EXPECT_EQ(frames[0], (n2k::Frame{0x18EEFF25, 8, {0x67, 0x12, 0x80, 0xFF, 0x00, 155, 120, 0xC0}}));
}

TEST(Membership, HasItsAddressAfterAQuarterOfASecond) {
  Membership membership(kPlate, {}, {});
  (void)run(membership, Time{}, Time{250'000});
  EXPECT_FALSE(membership.address().has_value());
  (void)run(membership, Time{250'000}, Time{250'001});
  EXPECT_EQ(membership.address(), 0x25);
}

TEST(Membership, ListsItsOwnGroupsBesideThoseOfEveryDevice) {
  Membership membership(kPlate, {n2k::kSpeedPgn}, {});
  (void)run(membership, Time{}, Time{1'000'000});
  // Who asks for its list (126464 = 0x1EE00) is at 0x40.
  membership.accept({.identifier = 0x18EA2540, .size = 3, .data = {0x00, 0xEE, 0x01}}, Time{1'000'000});
  const Frames lists = of_group(n2k::kPgnListPgn, run(membership, Time{1'000'000}, Time{1'200'000}));
  // Transmitted: function 0 and eight groups of three bytes, 25 bytes: 4 frames; received: 3 groups, 10 bytes: 2 frames.
  ASSERT_EQ(lists.size(), 6U);
  EXPECT_EQ(lists[0].data[1], 25);
  // 128259 = 0x01F503 comes first.
  EXPECT_EQ(lists[0].data[3], 0x03);
  EXPECT_EQ(lists[0].data[4], 0xF5);
  EXPECT_EQ(lists[0].data[5], 0x01);
}

TEST(Membership, RefusesAUniqueNumberThatNoNameCanHold) {
  Nameplate plate = kPlate;
  plate.unique_number = 1U << 21U;
  EXPECT_THROW(Membership(plate, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace earshot::hil
