#include "hil/nodes/sensor.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

constexpr Nameplate kSensorPlate{
    .model = "test", .device_class = 60, .device_function = 155, .preferred_address = 0x25, .unique_number = 1};

/// Says nothing, notes when it was to.
class SensorTest : public testing::Test {
 protected:
  std::vector<Occasion> occasions_;
  Status answer_ = Status::kOk;
  Sensor sensor_{kSensorPlate,
                 {{.message = n2k::table::kSpeed, .period = Duration::milliseconds(100), .compose = [this](const Occasion& o, Frames&) {
                     occasions_.push_back(o);
                     return answer_;
                   }}}};
};

TEST_F(SensorTest, SaysNothingBeforeItHasAnAddress) {
  (void)run(sensor_, Time{}, Time{250'000});
  EXPECT_TRUE(occasions_.empty());
  (void)run(sensor_, Time{250'000}, Time{250'001});
  ASSERT_EQ(occasions_.size(), 1U);
  EXPECT_EQ(occasions_[0].source, 0x25);
}

TEST_F(SensorTest, KeepsItsPeriod) {
  (void)run(sensor_, Time{}, Time{10'250'000});
  EXPECT_EQ(occasions_.size(), 100U);
  EXPECT_EQ(occasions_.back().now, (Time{10'150'000}));
}

TEST_F(SensorTest, CountsItsMessagesFrom0To252AndThenAnew) {
  (void)run(sensor_, Time{}, Time{26'000'000});
  ASSERT_GT(occasions_.size(), 254U);
  EXPECT_EQ(occasions_[0].count, 0);
  EXPECT_EQ(occasions_[252].count, 252);
  EXPECT_EQ(occasions_[253].count, 0);
}

TEST_F(SensorTest, IsSilentWhileAnotherHasItsAddress) {
  (void)run(sensor_, Time{}, Time{1'000'000});
  const std::size_t before = occasions_.size();
  // A device of NAME 0 claims its address; the next, 0x26, is its own after a quarter of a second.
  sensor_.accept({.identifier = 0x18EEFF25, .size = 8, .data = {}}, Time{1'000'000});
  (void)run(sensor_, Time{1'000'000}, Time{1'250'000});
  EXPECT_EQ(occasions_.size(), before);
  (void)run(sensor_, Time{1'250'000}, Time{1'300'000});
  ASSERT_GT(occasions_.size(), before);
  EXPECT_EQ(occasions_.back().source, 0x26);
}

TEST_F(SensorTest, CountsWhatDoesNotFitItsMessage) {
  answer_ = Status::kOutOfRange;
  (void)run(sensor_, Time{}, Time{450'000});
  EXPECT_EQ(sensor_.unsent(), 2U);
  EXPECT_EQ(sensor_.sent(), 0U);
}

}  // namespace
}  // namespace earshot::hil
