#include "firmware/wire/n2k/sensors/directory.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"

namespace earshot::n2k {
namespace {

/// Addresses that a device may have: 254 and 255 are nobody's.
constexpr unsigned kAddresses = 254;
constexpr Name kFirst = 0xC050'9635'E772'EE1F;

/// Of as many devices as one likes.
Name name_of_device(unsigned index) {
  return kFirst + index;
}

class DirectoryTest : public ::testing::Test {
 protected:
  void claim(Name name, unsigned address) {
    Frame frame{.identifier = 0x18EEFF00U | address};
    for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(name >> (8 * i));
    directory_.accept(static_cast<std::uint8_t>(address), frame);
  }
  [[nodiscard]] std::optional<Name> at(unsigned address) const { return directory_.name_of(static_cast<std::uint8_t>(address)); }
  /// A device at every address from 0 on, until there is room for no more.
  void fill() {
    for (unsigned address = 0; address < config::kKnownDevices; ++address) claim(name_of_device(address), address);
    ASSERT_EQ(directory_.unknown(), 0U);
  }

  Directory directory_;
};

TEST_F(DirectoryTest, KnowsTheDeviceAtEveryAddressUpToItsCapacityAndNobodyElsewhere) {
  fill();
  for (unsigned address = 0; address < 256; ++address)
    EXPECT_EQ(at(address), address < config::kKnownDevices ? std::optional(name_of_device(address)) : std::nullopt) << address;
}

TEST_F(DirectoryTest, CountsClaimsBeyondItsCapacityAndKeepsThoseThatItKnows) {
  fill();
  for (unsigned address = config::kKnownDevices; address < kAddresses; ++address) claim(name_of_device(address), address);
  EXPECT_EQ(directory_.unknown(), kAddresses - config::kKnownDevices);
  for (unsigned address = 0; address < kAddresses; ++address)
    EXPECT_EQ(at(address).has_value(), address < config::kKnownDevices) << address;
}

TEST_F(DirectoryTest, HasRoomForADeviceThatMovesOrThatTakesTheAddressOfAnotherThoughItIsFull) {
  fill();
  claim(name_of_device(0), 1);
  EXPECT_EQ(at(0), std::nullopt);
  EXPECT_EQ(at(1), name_of_device(0)) << "in the place of 1";
  claim(name_of_device(1000), 1);
  EXPECT_EQ(at(1), name_of_device(1000));
  claim(name_of_device(2), 0);
  EXPECT_EQ(at(2), std::nullopt);
  EXPECT_EQ(at(0), name_of_device(2));
  EXPECT_EQ(directory_.unknown(), 0U);
}

TEST_F(DirectoryTest, HasRoomAgainWhenADeviceGaveUpItsAddress) {
  fill();
  constexpr unsigned kNullAddressClaim = 254;
  claim(name_of_device(3), kNullAddressClaim);
  EXPECT_EQ(at(3), std::nullopt);
  claim(name_of_device(1000), 3);
  EXPECT_EQ(at(3), name_of_device(1000));
  EXPECT_EQ(directory_.unknown(), 0U);
}

TEST_F(DirectoryTest, KnowsNobodyByANameOfZeroOrByAClaimCutShort) {
  claim(kFirst, 7);
  Frame cut{.identifier = 0x18EEFF07U, .size = 7};
  directory_.accept(7, cut);
  EXPECT_EQ(at(7), kFirst);
  claim(0, 7);
  EXPECT_EQ(at(7), std::nullopt);
  claim(0, 8);
  EXPECT_EQ(at(8), std::nullopt);
}

}  // namespace
}  // namespace earshot::n2k
