#include "firmware/wire/n2k/own/hull_alarms.hpp"

#include <gtest/gtest.h>

namespace earshot::n2k {
namespace {

constexpr std::uint8_t kBow = 0x51;
constexpr std::uint8_t kStern = 0x52;
constexpr Name kNameOfBow = 0xC050'9635'E772'EE1F;

Hull wet(std::uint8_t instance = 0) {
  return {.instance = instance, .wet = true, .has_ground_fault = {}};
}
Hull dry(std::uint8_t instance = 0) {
  return {.instance = instance, .wet = false, .has_ground_fault = {}};
}

class HullAlarmsTest : public testing::Test {
 protected:
  void take(const Hull& hull, std::uint8_t source = kBow) { alarms_.take(hull, source, directory_); }
  void claim(Name name, std::uint8_t address) {
    Frame frame{.identifier = 0x18EEFF00U | address, .size = 8, .data = {}};
    for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(name >> (8 * i));
    directory_.accept(address, frame);
  }
  HullAlarms alarms_;
  Directory directory_;
};

TEST_F(HullAlarmsTest, AreThereWhenADeviceSaysSoAndOverWhenItTakesItBack) {
  take(dry());
  EXPECT_FALSE(alarms_.has_leak());
  take(wet());
  EXPECT_TRUE(alarms_.has_leak());
  EXPECT_FALSE(alarms_.has_ground_fault());
  take(dry());
  EXPECT_FALSE(alarms_.has_leak());
}

TEST_F(HullAlarmsTest, OfOneDeviceAreNotTakenBackByAnother) {
  take(wet(), kBow);
  take(dry(), kStern);
  EXPECT_TRUE(alarms_.has_leak());
  take(dry(1), kBow);
  EXPECT_TRUE(alarms_.has_leak()) << "another compartment of the same device";
}

TEST_F(HullAlarmsTest, LastUntilEveryDeviceHasTakenItsOwnBack) {
  take(wet(), kBow);
  take(wet(), kStern);
  take(dry(), kBow);
  EXPECT_TRUE(alarms_.has_leak());
  take(dry(), kStern);
  EXPECT_FALSE(alarms_.has_leak());
}

TEST_F(HullAlarmsTest, StayWithADeviceThatDoesNotKnowAnyMore) {
  take({.instance = 0, .wet = true, .has_ground_fault = true});
  take({.instance = 0, .wet = {}, .has_ground_fault = false});
  EXPECT_TRUE(alarms_.has_leak());
  EXPECT_FALSE(alarms_.has_ground_fault());
  take({.instance = 0, .wet = false, .has_ground_fault = {}});
  EXPECT_FALSE(alarms_.has_leak());
}

TEST_F(HullAlarmsTest, AreTakenBackByTheirDeviceFromAnotherAddress) {
  claim(kNameOfBow, kBow);
  take(wet(), kBow);
  claim(kNameOfBow, kStern);
  take(dry(), kBow);
  EXPECT_TRUE(alarms_.has_leak()) << "it is nobody's address now";
  take(dry(), kStern);
  EXPECT_FALSE(alarms_.has_leak());
}

TEST_F(HullAlarmsTest, BeyondTheirCapacityStand) {
  for (std::uint8_t i = 0; i < config::kHullAlarms; ++i) take(wet(i));
  take({.instance = 200, .wet = true, .has_ground_fault = true});
  take({.instance = 200, .wet = false, .has_ground_fault = false});
  for (std::uint8_t i = 0; i < config::kHullAlarms; ++i) take(dry(i));
  EXPECT_TRUE(alarms_.has_leak());
  EXPECT_TRUE(alarms_.has_ground_fault());
  take({.instance = 200, .wet = false, .has_ground_fault = false});
  EXPECT_TRUE(alarms_.has_leak());
  EXPECT_TRUE(alarms_.has_ground_fault());
}

TEST_F(HullAlarmsTest, HaveRoomAgainOnceOthersAreOver) {
  for (std::uint8_t i = 0; i < config::kHullAlarms; ++i) take(wet(i));
  take(dry(3));
  take(wet(200));
  for (std::uint8_t i = 0; i < config::kHullAlarms; ++i) take(dry(i));
  EXPECT_TRUE(alarms_.has_leak());
  take(dry(200));
  EXPECT_FALSE(alarms_.has_leak());
}

}  // namespace
}  // namespace earshot::n2k
