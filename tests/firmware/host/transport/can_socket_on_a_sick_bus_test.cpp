#include <linux/can/error.h>

#include <array>
#include <vector>

#include "tests/firmware/host/transport/can_bus.hpp"

namespace earshot::host {
namespace {

using State = n2k::ControllerState;

Time at_s(double seconds) {
  return Time{static_cast<std::int64_t>(seconds * 1e6)};
}

/// A group of `size` frames.
std::vector<n2k::Frame> group(std::size_t size, std::uint8_t tag, unsigned priority = 2) {
  std::vector<n2k::Frame> frames;
  for (std::size_t i = 0; i < size; ++i)
    frames.push_back({.identifier = priority << 26U | 0x1F105CCU, .size = 8, .data = {static_cast<std::uint8_t>(i), tag}});
  return frames;
}

class CanOnASickBus : public CanBusTest {
 protected:
  /// Tags of all that comes.
  static std::vector<int> tags_read(CanSocket& socket) {
    std::vector<int> tags;
    do {
      for (n2k::Frame frame; socket.receive(frame) == Status::kOk;) tags.push_back(frame.data[1]);
    } while (more_comes(socket));
    return tags;
  }
};

TEST_F(CanOnASickBus, KnowsTheControllersStateFromErrorFramesAndTakesNoneForAMessage) {
  CanSocket socket(kBus);
  EXPECT_EQ(socket.controller_state(), State::kErrorActive);
  give_error(socket, CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING);
  EXPECT_TRUE(socket.controller().is_warned());
  give_error(socket, CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_EQ(socket.controller_state(), State::kErrorPassive);
  EXPECT_TRUE(socket.is_up());
  give_error(socket, CAN_ERR_BUSOFF);
  EXPECT_EQ(socket.controller_state(), State::kBusOff);
  EXPECT_FALSE(socket.is_up());
  give_error(socket, CAN_ERR_RESTARTED);
  EXPECT_EQ(socket.controller_state(), State::kErrorActive);
  EXPECT_TRUE(socket.is_up());
  EXPECT_EQ(socket.counters().controller.frames, 4U);
  EXPECT_EQ(socket.counters().received, 0U);
  EXPECT_EQ(socket.counters().other_frames, 0U);
}

TEST_F(CanOnASickBus, DoesNotAskForSingleBitErrors) {
  CanSocket socket(kBus);
  put_error(CAN_ERR_PROT);
  put_error(CAN_ERR_BUSERROR);
  give_error(socket, CAN_ERR_ACK);
  EXPECT_EQ(socket.counters().controller.frames, 1U);
  EXPECT_EQ(socket.counters().controller.not_acknowledged, 1U);
}

TEST_F(CanOnASickBus, SendsNothingWhileBusOffAndTheNewestSetpointOnceItsWaitIsOver) {
  CanSocket socket(kBus);
  CanSocket autopilot(kBus);
  constexpr Waiting kSetpoint{.kept = WhileWaiting::kKeepNewest, .longest = Duration::seconds(10)};
  give_error(socket, CAN_ERR_BUSOFF);
  EXPECT_EQ(socket.send(heading_frame(1)), Status::kFull);
  EXPECT_EQ(socket.send_whole(group(4, 1), at_s(0), kSetpoint), Status::kNotReady);
  EXPECT_EQ(socket.send_whole(group(4, 2), at_s(0.5), kSetpoint), Status::kNotReady);
  give_error(socket, CAN_ERR_RESTARTED);
  socket.flush(at_s(0.9));
  EXPECT_EQ(tags_read(autopilot), (std::vector<int>{}));
  socket.flush(at_s(1));
  EXPECT_EQ(tags_read(autopilot), (std::vector{2, 2, 2, 2}));
  EXPECT_EQ(socket.counters().groups.replaced, 1U);
  EXPECT_EQ(socket.counters().bus_off_retries, 1U);
  EXPECT_EQ(socket.counters().send_failed, 1U);
}

TEST_F(CanOnASickBus, TriesAgainEvenIfNobodyToldOfTheRestart) {
  CanSocket socket(kBus);
  CanSocket autopilot(kBus);
  give_error(socket, CAN_ERR_BUSOFF);
  socket.flush(at_s(0));
  socket.flush(at_s(1));
  EXPECT_TRUE(socket.is_up()) << "the interface has its carrier";
  EXPECT_EQ(socket.send(heading_frame(1)), Status::kOk);
  give_error(socket, CAN_ERR_BUSOFF);
  socket.flush(at_s(2));
  socket.flush(at_s(3.9));
  EXPECT_EQ(socket.send(heading_frame(2)), Status::kFull) << "twice as long the second time";
  socket.flush(at_s(4));
  EXPECT_EQ(socket.send(heading_frame(3)), Status::kOk);
  EXPECT_EQ(socket.counters().bus_off_retries, 2U);
}

/// A queue of `room` frames that gives none of them back within the test.
bool clog(int room) {
  return iproute("tc qdisc replace dev vcan91 root netem delay 100s limit " + std::to_string(room));
}
bool unclog() {
  return iproute("tc qdisc replace dev vcan91 root pfifo limit 100");
}

TEST_F(CanOnASickBus, CountsAndTellsAFrameForWhichThereIsNoRoom) {
  ASSERT_TRUE(clog(3));
  CanSocket socket(kBus);
  for (std::uint8_t i = 0; i < 3; ++i) EXPECT_EQ(socket.send(heading_frame(i)), Status::kOk);
  EXPECT_EQ(socket.send(heading_frame(3)), Status::kFull);
  EXPECT_EQ(socket.send(heading_frame(4)), Status::kFull);
  EXPECT_EQ(socket.counters().sent, 3U);
  EXPECT_EQ(socket.counters().send_failed, 2U);
  EXPECT_EQ(socket.counters().no_room, 2U);
  EXPECT_TRUE(socket.is_up());
}

TEST_F(CanOnASickBus, SendsTheRestOfAGroupBeforeAllThatIsNoMoreUrgent) {
  ASSERT_TRUE(clog(3));
  CanSocket socket(kBus);
  CanSocket autopilot(kBus);
  EXPECT_EQ(socket.send_whole(group(5, 1), at_s(0)), Status::kNotReady);
  EXPECT_EQ(socket.send_whole(group(1, 2, 2), at_s(0)), Status::kNotReady);
  EXPECT_EQ(socket.send_whole(group(1, 3, 6), at_s(0)), Status::kNotReady);
  EXPECT_EQ(socket.send(heading_frame(4)), Status::kFull) << "nothing overtakes what waits";
  EXPECT_EQ(socket.counters().sent, 3U);
  ASSERT_TRUE(unclog());  // the three that were in the old queue are gone with it
  socket.flush(at_s(0.4));
  EXPECT_EQ(tags_read(autopilot), (std::vector{1, 1, 2, 3}));
  EXPECT_EQ(socket.counters().groups.sent, 3U);
}

TEST_F(CanOnASickBus, AbandonsAGroupWhoseRestFindsNoRoomInTime) {
  ASSERT_TRUE(clog(3));
  CanSocket socket(kBus);
  CanSocket autopilot(kBus);
  EXPECT_EQ(socket.send_whole(group(5, 1), at_s(0)), Status::kNotReady);
  ASSERT_TRUE(unclog());
  socket.flush(at_s(0.6));
  EXPECT_EQ(tags_read(autopilot), (std::vector<int>{}));
  EXPECT_EQ(socket.counters().groups.abandoned, 1U);
  EXPECT_EQ(socket.waiting(), 0U);
}

TEST_F(CanOnASickBus, IsOnAnInterfaceThatWasTakenAwayAndMadeAnewWithTheSameFilters) {
  CanOptions options;
  ASSERT_EQ(filters_for(std::array<std::uint32_t, 1>{127250}, options.filters), Status::kOk);
  CanSocket socket(kBus, IfMissing::kRefuse, options);
  const unsigned index = ::if_nametoindex(kBus);
  ASSERT_TRUE(iproute("ip link del vcan91 && ip link add vcan90 type vcan && ip link add vcan91 type vcan && ip link set vcan91 up"));
  ASSERT_NE(::if_nametoindex(kBus), index);
  n2k::Frame frame;
  EXPECT_EQ(socket.receive(frame), Status::kNotReady);
  EXPECT_FALSE(socket.is_up()) << "another interface of that name";
  EXPECT_TRUE(socket.reopen());
  CanSocket other(kBus);
  ASSERT_EQ(other.send(group(1, 7)[0]), Status::kOk);  // 127237: not asked for
  ASSERT_EQ(other.send(heading_frame(9)), Status::kOk);
  ASSERT_TRUE(wait_for(socket));
  ASSERT_EQ(socket.receive(frame), Status::kOk);
  EXPECT_EQ(frame, heading_frame(9));
  EXPECT_EQ(socket.counters().received, 1U);
  EXPECT_TRUE(iproute("ip link del vcan90"));
}

TEST_F(CanOnASickBus, IsBoundAnewToAnInterfaceThatCameBackWithItsOldIndex) {
  CanSocket socket(kBus);
  const std::string index = std::to_string(::if_nametoindex(kBus));
  ASSERT_TRUE(iproute("ip link del vcan91 && ip link add vcan91 index " + index + " type vcan && ip link set vcan91 up"));
  n2k::Frame frame;
  EXPECT_EQ(socket.receive(frame), Status::kNotReady);
  EXPECT_FALSE(socket.is_up()) << "it is bound to the one that is gone";
  EXPECT_TRUE(socket.reopen());
  CanSocket other(kBus);
  ASSERT_EQ(other.send(heading_frame(9)), Status::kOk);
  ASSERT_TRUE(wait_for(socket));
  EXPECT_EQ(socket.receive(frame), Status::kOk);
  EXPECT_EQ(frame, heading_frame(9));
}

}  // namespace
}  // namespace earshot::host
