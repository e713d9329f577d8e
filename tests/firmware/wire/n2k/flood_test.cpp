// More fast packets at once than there are slots for, in the profile that this is compiled for: tests/firmware/wire/n2k/CMakeLists.txt does
// so for a vehicle computer's and for a microcontroller's.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/sensors/sensors.hpp"

namespace earshot::n2k {
namespace {

constexpr std::size_t kSlots = config::kFastPacketSlots;
constexpr std::size_t kBeyond = 3;
constexpr std::size_t kFrames = 7;  // of 129029 without reference stations: 43 bytes, 6 and 6 times 7
constexpr Time kNow{1'000'000'000};

FastPacketFrames position_of(std::size_t device) {
  MessageWriter writer(kGnssPgn);
  writer.set("Latitude", 46.0 + 0.125 * static_cast<double>(device)).set("Longitude", -1.3).set("Method", 1);
  FastPacketFrames frames;
  EXPECT_EQ(compose_fast_packet(writer.identifier(static_cast<std::uint8_t>(device)), 0, writer.bytes(), frames), Status::kOk);
  EXPECT_EQ(frames.size(), kFrames);
  return frames;
}

class FloodOfPositions : public ::testing::Test {
 protected:
  /// So many devices send a position each, one frame of one after one frame of another.
  void send_at_once(std::size_t devices) {
    std::vector<FastPacketFrames> all;
    for (std::size_t device = 0; device < devices; ++device) all.push_back(position_of(device));
    for (std::size_t i = 0; i < kFrames; ++i)
      for (const FastPacketFrames& frames : all) static_cast<void>(sensors_.accept(frames[i], kNow, measured_));
  }
  [[nodiscard]] const FastPacketCounters& counters() const { return sensors_.fast_packet_counters(); }

  Sensors sensors_;
  Measured measured_{};
};

TEST_F(FloodOfPositions, LosesNothingAsLongAsEveryMessageHasASlot) {
  send_at_once(kSlots);
  EXPECT_EQ(counters().completed, kSlots);
  EXPECT_EQ(counters().abandoned, 0U);
  EXPECT_EQ(counters().stray, 0U);
  EXPECT_EQ(sensors_.readings().position->value.latitude_deg, 46.0) << "of the first";
}

TEST_F(FloodOfPositions, LosesOneMessageForEachThatHasNoSlotAndCountsItAndItsFrames) {
  send_at_once(kSlots + kBeyond);
  EXPECT_EQ(counters().completed, kSlots);
  EXPECT_EQ(counters().abandoned, kBeyond);
  EXPECT_EQ(counters().stray, kBeyond * (kFrames - 1));
  EXPECT_EQ(sensors_.counters().refused, kBeyond * (kFrames - 1)) << "as the port's report says it";
  EXPECT_EQ(sensors_.readings().position->value.latitude_deg, 46.375) << "of the first that was not given up";
}

TEST_F(FloodOfPositions, IsForgottenWhenItIsOver) {
  send_at_once(kSlots + kBeyond);
  send_at_once(kSlots);
  EXPECT_EQ(counters().completed, 2 * kSlots);
  EXPECT_EQ(counters().abandoned, kBeyond);
}

TEST_F(FloodOfPositions, TakesNoSlotFromADeviceBetweenWhoseFramesFewerBeginThanThereAreSlots) {
  constexpr std::size_t kOurs = 200;
  std::size_t other = 0;
  Status status = Status::kNotReady;
  for (const Frame& frame : position_of(kOurs)) {
    status = sensors_.accept(frame, kNow, measured_);
    for (std::size_t i = 0; i + 1 < kSlots; ++i) static_cast<void>(sensors_.accept(position_of(other++)[0], kNow, measured_));
  }
  EXPECT_EQ(status, Status::kOk);
  EXPECT_EQ(sensors_.readings().position->value.latitude_deg, 71.0);
  EXPECT_GT(counters().abandoned, 0U);
}

/// 126720, to us, from devices that never end what they begin.
TEST(FloodOfOrders, LeavesAnOrderOfOneFrameThatAborts) {
  constexpr std::uint8_t kUs = 0x40;
  OrderReceiver orders;
  messages::OperatorCommand command;
  std::uint8_t sender = 0;
  for (std::size_t device = 0; device < 3 * kSlots; ++device) {
    const Identifier identifier{.pgn = kPeerPgn, .priority = 3, .source = static_cast<std::uint8_t>(device), .destination = kUs};
    FastPacketFrames frames;
    ASSERT_EQ(compose_fast_packet(identifier, 0, std::vector<std::uint8_t>(223, 0xEE), frames), Status::kOk);
    EXPECT_EQ(orders.accept(frames[0], kNow, kUs, command, sender), Status::kNotReady);
  }
  Frame abort;
  ASSERT_EQ(compose_abort(7, 1, {.source = 250, .destination = kUs, .sequence = 0}, abort), Status::kOk);
  ASSERT_EQ(orders.accept(abort, kNow, kUs, command, sender), Status::kOk);
  EXPECT_EQ(command.order, messages::Order::kAbort);
  EXPECT_EQ(sender, 250);
}

}  // namespace
}  // namespace earshot::n2k
