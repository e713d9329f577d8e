#include "firmware/wire/n2k/node/identity.hpp"

#include <gtest/gtest.h>

namespace earshot::n2k {
namespace {

TEST(Name, IsThatOfARecordedDeviceOfTheSameParts) {
  // Source 204 of the recorded bus: 1240607, maker 1851, instances 5 and 6, function 150, class 40.
  EXPECT_EQ(
      name_of({.unique_number = 1'240'607, .manufacturer = 1851, .device_instance = 5 + 8 * 6, .device_function = 150, .device_class = 40})
          .value(),
      0xC050'9635'E772'EE1F);
  EXPECT_EQ(name_of({.unique_number = 1U << 21U}).status(), Status::kOutOfRange);
  EXPECT_EQ(name_of({.unique_number = 1, .system_instance = 14}).status(), Status::kOutOfRange);
}

TEST(Name, OfWhomNobodyDescribedIsThatOfAnAutopilotWithoutANumber) {
  // From below: number 0, maker 2044 (0x7FC << 21), instance 0, function 150 (0x96), a spare bit, class 40 (0x50 with it), system 0,
  // marine (4), and that it can claim any address (0xC0 with both).
  EXPECT_EQ(name_of({}).value(), 0xC050'9600'FF80'0000);
  EXPECT_EQ(Identity{}.name, 0U);
  EXPECT_EQ(Identity{}.preferred_address, 0x40);
}

}  // namespace
}  // namespace earshot::n2k
