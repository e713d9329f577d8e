#include <linux/sock_diag.h>

#include <array>
#include <chrono>
#include <thread>

#include "tests/firmware/host/transport/can_bus.hpp"

namespace earshot::host {
namespace {

class CanLoad : public CanBusTest {
 protected:
  /// Bytes that wait in the socket, as the kernel counts them.
  static std::uint32_t waiting_bytes(const CanSocket& socket) {
    std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
    socklen_t size = sizeof info;
    EXPECT_EQ(::getsockopt(socket.file_descriptor(), SOL_SOCKET, SO_MEMINFO, info.data(), &size), 0);
    return info[SK_MEMINFO_RMEM_ALLOC];
  }
  /// Frames, with rests in which the kernel empties its backlog (net.core.netdev_max_backlog, 1000 frames): what is lost there, no socket
  /// knows of.
  static void send_many(CanSocket& socket, int frames, const n2k::Frame& frame) {
    for (int i = 0; i < frames; ++i) {
      ASSERT_EQ(socket.send(frame), Status::kOk);
      if (i % 200 == 199) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  static std::uint64_t read_all(CanSocket& socket) {
    std::uint64_t frames = 0;
    do {
      for (n2k::Frame frame; socket.receive(frame) == Status::kOk;) ++frames;
    } while (more_comes(socket));
    return frames;
  }
};

TEST_F(CanLoad, AFrameThatWaitsCostsTheKernelNoMoreThanSaid) {
  CanSocket alice(kBus);
  CanSocket bob(kBus);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(alice.send(heading_frame(1)), Status::kOk);
  ASSERT_TRUE(wait_for(bob));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until all are there
  const std::uint64_t bytes = waiting_bytes(bob);
  const std::uint64_t frames = read_all(bob);
  ASSERT_GT(frames, 0U);
  RecordProperty("bytes_per_frame", static_cast<int>(bytes / frames));
  EXPECT_GT(bytes, 0U);
  EXPECT_LE(bytes, frames * kFrameInKernel_bytes);
}

TEST_F(CanLoad, HoldsASecondOfAFullBusWhereItMayAskForThat) {
  CanSocket alice(kBus);
  CanSocket bob(kBus);
  if (bob.room_frames() < 8000) GTEST_SKIP() << "not granted: this needs CAP_NET_ADMIN";
  send_many(alice, 8000, heading_frame(1));
  EXPECT_EQ(read_all(bob), 8000U);
  EXPECT_EQ(bob.counters().lost_by_kernel, 0U);
}

TEST_F(CanLoad, SaysWhatRoomItWasGranted) {
  CanSocket bob(kBus, IfMissing::kRefuse, {.filters = {}, .room_frames = 100});
  EXPECT_EQ(bob.room_frames(), 100U);
}

TEST_F(CanLoad, LosesNoFrameThatItDoesNotTellOf) {
  CanSocket alice(kBus);
  CanSocket bob(kBus, IfMissing::kRefuse, {.filters = {}, .room_frames = 500});
  const std::uint64_t before = received_by_interface();
  can_frame short_identifier{};
  short_identifier.can_id = 0x123;
  std::uint64_t sent = 0;
  for (int burst = 1; burst <= 20; ++burst) {
    send_many(alice, burst * 100, heading_frame(1));
    put(short_identifier);
    sent += static_cast<std::uint64_t>(burst) * 100 + 1;
    if (burst % 3 != 0) (void)read_all(bob);
  }
  (void)read_all(bob);
  const CanCounters told = bob.counters();
  EXPECT_GT(told.lost_by_kernel, 0U);
  EXPECT_EQ(received_by_interface() - before, sent);
  EXPECT_EQ(told.received + told.other_frames + told.lost_by_kernel, sent);
}

TEST_F(CanLoad, IsNotWokenByWhatItsFilterKeepsAwayNorHasItsRoomTaken) {
  CanOptions options{.filters = {}, .room_frames = 100};
  ASSERT_EQ(filters_for(std::array<std::uint32_t, 1>{127250}, std::array<std::uint32_t, 1>{59904}, 0x40, options.filters), Status::kOk);
  CanSocket alice(kBus);
  CanSocket bob(kBus, IfMissing::kRefuse, options);
  send_many(alice, 2000, {.identifier = 0x09F10DCC, .size = 8, .data = {}});              // 127245
  ASSERT_EQ(alice.send({.identifier = 0x18EA41CC, .size = 3, .data = {}}), Status::kOk);  // to another
  can_frame short_identifier{};
  short_identifier.can_id = 0x123;
  put(short_identifier);
  EXPECT_EQ(waiting_bytes(bob), 0U);
  ASSERT_EQ(alice.send(heading_frame(1, 0x00)), Status::kOk);
  ASSERT_EQ(alice.send(heading_frame(2, 0xFD)), Status::kOk);
  ASSERT_EQ(alice.send({.identifier = 0x18EA40CC, .size = 3, .data = {}}), Status::kOk);
  ASSERT_EQ(alice.send({.identifier = 0x18EAFFCC, .size = 3, .data = {}}), Status::kOk);
  EXPECT_EQ(read_all(bob), 4U);
  EXPECT_EQ(bob.counters().other_frames, 0U);
  EXPECT_EQ(bob.counters().lost_by_kernel, 0U);
}

TEST_F(CanLoad, ReadsByOtherFiltersOnceItsAddressHasChanged) {
  CanOptions options;
  ASSERT_EQ(filters_for({}, std::array<std::uint32_t, 1>{59904}, 0x40, options.filters), Status::kOk);
  CanSocket alice(kBus);
  CanSocket bob(kBus, IfMissing::kRefuse, options);
  CanFilters others;
  ASSERT_EQ(filters_for({}, std::array<std::uint32_t, 1>{59904}, 0x41, others), Status::kOk);
  ASSERT_TRUE(bob.set_filters(others));
  ASSERT_EQ(alice.send({.identifier = 0x18EA40CC, .size = 3, .data = {}}), Status::kOk);
  ASSERT_EQ(alice.send({.identifier = 0x18EA41CC, .size = 3, .data = {}}), Status::kOk);
  n2k::Frame frame;
  ASSERT_TRUE(wait_for(bob));
  ASSERT_EQ(bob.receive(frame), Status::kOk);
  EXPECT_EQ(frame.identifier, 0x18EA41CCU);
  EXPECT_EQ(bob.receive(frame), Status::kNotReady);
}

TEST_F(CanLoad, NeverSeesFramesOfCanFdAndTakesNoneForAMessageIfTheyComeAnyhow) {
  CanSocket alice(kBus);
  CanSocket bob(kBus);
  canfd_frame large{};
  large.can_id = 0x09F112CC | CAN_EFF_FLAG;
  large.len = 8;  // in size a message, in kind none
  put(large);
  ASSERT_EQ(alice.send(heading_frame(2)), Status::kOk);
  n2k::Frame frame;
  ASSERT_TRUE(wait_for(bob)) << "what came before it has been judged then: a bus delivers late on a busy computer";
  ASSERT_EQ(bob.receive(frame), Status::kOk);
  EXPECT_EQ(frame, heading_frame(2));
  EXPECT_EQ(bob.counters().other_frames, 0U);
  const int on = 1;
  ASSERT_EQ(::setsockopt(bob.file_descriptor(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on), 0);
  put(large);
  ASSERT_EQ(alice.send(heading_frame(3)), Status::kOk);
  ASSERT_TRUE(wait_for(bob));
  ASSERT_EQ(bob.receive(frame), Status::kOk);
  EXPECT_EQ(frame, heading_frame(3));
  EXPECT_EQ(bob.counters().other_frames, 1U);
}

}  // namespace
}  // namespace earshot::host
