#include "firmware/wire/n2k/vehicle_state/vehicle_condition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace earshot::n2k {
namespace {

constexpr Time kNow{1'000'000'000};
constexpr Duration kOldestAltitude = Duration::seconds(3);

constexpr Duration ms(std::int64_t count) {
  return Duration::milliseconds(count);
}

class VehicleConditionTest : public testing::Test {
 protected:
  /// 128267 at priority 3 from 0x2A, hundredths of a metre; all ones: none in reach.
  void altitude(std::uint32_t centimetres) {
    Frame frame{.identifier = 0x0DF50B2A, .size = 8, .data = {0, 0, 0, 0, 0, 0xFF, 0x7F, 0xFF}};
    for (unsigned i = 0; i < 4; ++i) frame.data[1 + i] = static_cast<std::uint8_t>(centimetres >> (8 * i));
    Measured measured{};
    (void)sensors_.accept(frame, now_, measured);
  }
  /// 127506 at priority 6 from 0x2B: a fast packet of 11 bytes; percent are byte 3.
  void charge(std::uint8_t percent) {
    const auto head = static_cast<std::uint8_t>(32 * (packets_++ % 8));
    Measured measured{};
    (void)sensors_.accept(Frame{.identifier = 0x19F2122B, .size = 8, .data = {head, 11, 0xFF, 0, 0, percent, 0xFF, 0xFF}}, now_, measured);
    (void)sensors_.accept(
        Frame{.identifier = 0x19F2122B, .size = 8, .data = {static_cast<std::uint8_t>(head + 1), 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}},
        now_, measured);
  }
  /// 65293 from 0x2C: leak in bits 0 and 1 of byte 3, ground fault in bits 2 and 3.
  Status hull(std::uint8_t states) {
    return condition_.accept_hull(Frame{.identifier = 0x04FF0D2C, .size = 8, .data = {0xFC, 0x9F, 0, states, 0xFF, 0xFF, 0xFF, 0xFF}},
                                  sensors_.directory(), now_);
  }
  std::optional<messages::VehicleStatus> given() {
    messages::VehicleStatus status;
    return condition_.give(sensors_, now_, status) == Status::kOk ? std::optional(status) : std::nullopt;
  }
  void pass(Duration time) { now_ = now_ + time; }

  static constexpr std::uint32_t kNoBottom = 0xFFFF'FFFF;
  static constexpr std::uint8_t kDry = 0xFC;
  static constexpr std::uint8_t kWet = 0xFD;
  static constexpr std::uint8_t kGroundFault = 0xF7;

  Sensors sensors_;
  VehicleCondition condition_{kOldestAltitude};
  Time now_ = kNow;
  unsigned packets_ = 0;
};

TEST_F(VehicleConditionTest, IsNotGivenBeforeAnythingIsHeard) {
  EXPECT_FALSE(given());
}

TEST_F(VehicleConditionTest, IsMadeOfWhatSeveralDevicesSay) {
  altitude(4250);
  charge(73);
  ASSERT_EQ(hull(kDry), Status::kOk);
  const auto status = given();
  ASSERT_TRUE(status);
  EXPECT_EQ(*status, (messages::VehicleStatus{.time = kNow, .altitude = Meters{42.5}, .battery_percent = 73}));
}

TEST_F(VehicleConditionTest, OfAPartThatNobodyToldIsNotKnown) {
  ASSERT_EQ(hull(kDry), Status::kOk);
  const auto status = given();
  ASSERT_TRUE(status);
  EXPECT_TRUE(std::isnan(status->altitude.value));
  EXPECT_TRUE(std::isnan(status->battery_percent));
}

TEST_F(VehicleConditionTest, IsGivenOnceForWhatIsNewAndNoMoreThanOnceASecond) {
  altitude(4250);
  ASSERT_TRUE(given());
  pass(Duration::seconds(5));
  EXPECT_FALSE(given()) << "nothing is new";
  altitude(4200);
  ASSERT_TRUE(given());
  pass(ms(899));
  altitude(4100);
  EXPECT_FALSE(given());
  pass(ms(1));
  const auto status = given();
  ASSERT_TRUE(status) << "what had to wait comes when it may, though nothing else does";
  EXPECT_EQ(status->altitude, Meters{41.0});
  EXPECT_EQ(status->time, now_ + ms(-1)) << "as it arrived";
}

TEST_F(VehicleConditionTest, WithANewAlarmDoesNotWait) {
  ASSERT_EQ(hull(kDry), Status::kOk);
  ASSERT_TRUE(given());
  pass(ms(10));
  ASSERT_EQ(hull(kWet), Status::kOk);
  const auto leak = given();
  ASSERT_TRUE(leak);
  EXPECT_TRUE(leak->has_leak);
  EXPECT_FALSE(leak->has_ground_fault);
  ASSERT_EQ(hull(kWet), Status::kOk);
  EXPECT_FALSE(given()) << "it is known by now";
  ASSERT_EQ(hull(kGroundFault), Status::kOk);
  const auto fault = given();
  ASSERT_TRUE(fault) << "though nothing has a later date";
  EXPECT_TRUE(fault->has_leak);
  EXPECT_TRUE(fault->has_ground_fault);
}

TEST_F(VehicleConditionTest, KeepsALeakWhoseSensorIsSilent) {
  ASSERT_EQ(hull(kWet), Status::kOk);
  ASSERT_TRUE(given());
  pass(Duration::seconds(36'000));
  altitude(4250);
  const auto status = given();
  ASSERT_TRUE(status);
  EXPECT_TRUE(status->has_leak);
}

TEST_F(VehicleConditionTest, OfAnAltimeterThatFindsNoBottomSaysSo) {
  altitude(4250);
  ASSERT_TRUE(given());
  pass(Duration::seconds(1));
  altitude(kNoBottom);
  const auto status = given();
  ASSERT_TRUE(status) << "it is news";
  EXPECT_EQ(status->time, now_);
  EXPECT_TRUE(std::isnan(status->altitude.value));
}

TEST_F(VehicleConditionTest, OfAnAltimeterThatHasNeverFoundABottomIsThere) {
  altitude(kNoBottom);
  const auto status = given();
  ASSERT_TRUE(status) << "a vehicle that is heard of has a status";
  EXPECT_TRUE(std::isnan(status->altitude.value));
}

TEST_F(VehicleConditionTest, HasNoPartThatIsTooOld) {
  altitude(4250);
  charge(73);
  pass(kOldestAltitude);
  ASSERT_EQ(hull(kDry), Status::kOk);
  EXPECT_EQ(given()->altitude, Meters{42.5});
  pass(ms(1000));
  ASSERT_EQ(hull(kDry), Status::kOk);
  const auto later = given();
  ASSERT_TRUE(later);
  EXPECT_TRUE(std::isnan(later->altitude.value));
  EXPECT_EQ(later->battery_percent, 73);
  now_ = kNow + Duration::seconds(15);  // ten periods of 127506
  ASSERT_EQ(hull(kDry), Status::kOk);
  EXPECT_EQ(given()->battery_percent, 73);
  pass(ms(900));
  ASSERT_EQ(hull(kDry), Status::kOk);
  EXPECT_TRUE(std::isnan(given()->battery_percent));
}

TEST_F(VehicleConditionTest, IsNotMadeOfAnotherMakersMessages) {
  const Frame stranger{.identifier = 0x04FF0D2C, .size = 8, .data = {0xFB, 0x9F, 0, kWet, 0xFF, 0xFF, 0xFF, 0xFF}};
  EXPECT_EQ(condition_.accept_hull(stranger, sensors_.directory(), now_), Status::kUnsupported);
  EXPECT_FALSE(given());
}

}  // namespace
}  // namespace earshot::n2k
