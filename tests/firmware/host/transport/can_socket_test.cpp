#include "firmware/host/transport/can_socket.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <system_error>
#include <thread>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {
namespace {

constexpr const char* kInterface = "vcan0";

n2k::Frame some_frame(std::uint8_t number) {
  return {.identifier = 0x09F112CC, .size = 8, .data = {number, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};
}

/// Run by hil/bus/with-can, which makes vcan0 and sets CAN_REQUIRED=1.
class CanSocketTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (::if_nametoindex(kInterface) != 0) return;
    const char* required = std::getenv("CAN_REQUIRED");
    ASSERT_FALSE(required != nullptr && std::string(required) == "1") << "CAN_REQUIRED=1, but there is no " << kInterface;
    GTEST_SKIP() << "no interface " << kInterface << ": run me with hil/bus/with-can";
  }

  static bool wait_for(const CanSocket& socket) {
    pollfd ready{socket.file_descriptor(), POLLIN, 0};
    return ::poll(&ready, 1, 5000) == 1;
  }

  /// A socket that sends anything.
  static void send_raw(canid_t identifier, std::uint8_t size) {
    const FileDescriptor socket(::socket(PF_CAN, SOCK_RAW, CAN_RAW));
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(kInterface));
    ASSERT_EQ(::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    can_frame frame{};
    frame.can_id = identifier;
    frame.can_dlc = size;
    ASSERT_EQ(::send(socket.number(), &frame, sizeof frame, 0), static_cast<ssize_t>(sizeof frame));
  }
};

TEST_F(CanSocketTest, CarriesAFrameFromOneSocketToAnotherAndNotBack) {
  CanSocket alice(kInterface);
  CanSocket bob(kInterface);
  ASSERT_EQ(alice.send(some_frame(7)), Status::kOk);
  n2k::Frame frame;
  ASSERT_TRUE(wait_for(bob));
  ASSERT_EQ(bob.receive(frame), Status::kOk);
  EXPECT_EQ(frame, some_frame(7));
  EXPECT_EQ(bob.receive(frame), Status::kNotReady);
  EXPECT_EQ(alice.receive(frame), Status::kNotReady);
}

TEST_F(CanSocketTest, KeepsTheSizeOfAShortFrame) {
  CanSocket alice(kInterface);
  CanSocket bob(kInterface);
  ASSERT_EQ(alice.send({.identifier = 0x18EA00AC, .size = 3, .data = {0x00, 0xEE, 0x00}}), Status::kOk);
  n2k::Frame frame;
  ASSERT_TRUE(wait_for(bob));
  ASSERT_EQ(bob.receive(frame), Status::kOk);
  EXPECT_EQ(frame.size, 3);
  EXPECT_EQ(frame.identifier, 0x18EA00ACU);
}

TEST_F(CanSocketTest, PassesOverElevenBitAndRemoteFramesAndCountsThem) {
  CanSocket alice(kInterface);
  CanSocket bob(kInterface);
  send_raw(0x123, 8);
  send_raw(0x09F112CC | CAN_EFF_FLAG | CAN_RTR_FLAG, 0);
  ASSERT_EQ(alice.send(some_frame(1)), Status::kOk);
  n2k::Frame frame;
  ASSERT_TRUE(wait_for(bob));
  ASSERT_EQ(bob.receive(frame), Status::kOk);
  EXPECT_EQ(frame, some_frame(1));
  EXPECT_EQ(bob.counters().other_frames, 2U);
}

TEST_F(CanSocketTest, ReadsNoMoreThanItsBudgetWhateverKindTheFramesAre) {
  CanSocket alice(kInterface);
  CanSocket bob(kInterface);
  for (int i = 0; i < 3; ++i) send_raw(0x123, 8);
  ASSERT_EQ(alice.send(some_frame(1)), Status::kOk);
  ASSERT_EQ(alice.send(some_frame(2)), Status::kOk);
  n2k::Frame frame;
  ASSERT_TRUE(wait_for(bob));
  Time received_utc;
  std::size_t budget = 2;
  EXPECT_EQ(bob.receive(frame, received_utc, budget), Status::kNotReady);
  EXPECT_EQ(bob.counters().other_frames, 2U);
  budget = 2;
  EXPECT_EQ(bob.receive(frame, received_utc, budget), Status::kOk);
  EXPECT_EQ(frame, some_frame(1));
  EXPECT_EQ(bob.receive(frame, received_utc, budget), Status::kNotReady);
  budget = 1;
  EXPECT_EQ(bob.receive(frame, received_utc, budget), Status::kOk);
  EXPECT_EQ(frame, some_frame(2));
}

TEST_F(CanSocketTest, CountsWhatTheKernelDroppedBecauseNobodyReadInTime) {
  CanSocket alice(kInterface);
  CanSocket bob(kInterface);
  std::uint64_t sent = 0;
  for (; sent < 20'000; ++sent) ASSERT_EQ(alice.send(some_frame(static_cast<std::uint8_t>(sent))), Status::kOk);
  n2k::Frame frame;
  std::uint64_t received = 0;
  while (bob.receive(frame) == Status::kOk) ++received;
  // Though no frame follows the last that was dropped.
  EXPECT_LT(received, sent);
  EXPECT_EQ(received + bob.counters().lost_by_kernel, sent);
}

TEST_F(CanSocketTest, SaysWhenTheKernelReceivedAFrameThoughItIsReadLater) {
  CanSocket alice(kInterface);
  CanSocket bob(kInterface);
  const auto utc_us = [] {
    return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  };
  const std::int64_t before = utc_us();
  ASSERT_EQ(alice.send(some_frame(1)), Status::kOk);
  const std::int64_t after = utc_us();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  n2k::Frame frame;
  Time received_utc;
  std::size_t budget = 1;
  ASSERT_EQ(bob.receive(frame, received_utc, budget), Status::kOk);
  EXPECT_GE(received_utc.us, before);
  EXPECT_LE(received_utc.us, after + 20'000) << "not when it was read; a timer of user-mode Linux ticks every 10 ms";
}

TEST_F(CanSocketTest, SaysThatItsInterfaceWentDownAndIsThereAgainWhenItComesBack) {
  const auto ip = [](const char* what) {
    return std::system((std::string("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link ") + what).c_str());
  };
  CanSocket alice(kInterface);
  CanSocket bob(kInterface);
  ASSERT_EQ(ip("set vcan0 down"), 0);
  n2k::Frame frame;
  EXPECT_EQ(bob.receive(frame), Status::kNotReady);
  EXPECT_FALSE(bob.is_up());
  EXPECT_GE(bob.counters().errors, 1U);
  EXPECT_FALSE(bob.reopen());
  EXPECT_EQ(alice.send(some_frame(1)), Status::kFull);
  EXPECT_FALSE(alice.is_up());
  ASSERT_EQ(ip("set vcan0 up"), 0);
  EXPECT_TRUE(bob.reopen());
  EXPECT_TRUE(alice.reopen());
  ASSERT_EQ(alice.send(some_frame(2)), Status::kOk);
  ASSERT_TRUE(wait_for(bob));
  ASSERT_EQ(bob.receive(frame), Status::kOk);
  EXPECT_EQ(frame, some_frame(2));
}

TEST_F(CanSocketTest, IsDownWhileItsInterfaceIsMissingAndOnItOnceItIsThere) {
  const auto ip = [](const char* what) {
    return std::system((std::string("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link ") + what).c_str());
  };
  CanSocket early("vcan78", IfMissing::kKeepTrying);
  n2k::Frame frame;
  EXPECT_FALSE(early.is_up());
  EXPECT_EQ(early.receive(frame), Status::kNotReady);
  EXPECT_EQ(early.send(some_frame(1)), Status::kFull);
  EXPECT_FALSE(early.reopen());
  ASSERT_EQ(ip("add vcan78 type vcan"), 0);
  EXPECT_FALSE(early.reopen()) << "it is there, and down";
  EXPECT_FALSE(CanSocket("vcan78").is_up()) << "likewise when it is opened so";
  ASSERT_EQ(ip("set vcan78 up"), 0);
  EXPECT_TRUE(early.reopen());
  CanSocket late("vcan78");
  ASSERT_EQ(late.send(some_frame(2)), Status::kOk);
  ASSERT_TRUE(wait_for(early));
  ASSERT_EQ(early.receive(frame), Status::kOk);
  EXPECT_EQ(frame, some_frame(2));
  ASSERT_EQ(ip("del vcan78"), 0);
}

TEST_F(CanSocketTest, RefusesAlwaysWhatNoCanInterfaceCanBe) {
  for (const char* name : {"", "a-name-of-16-byt", "a/b", "can0:1", "lo"})
    EXPECT_THROW(CanSocket(name, IfMissing::kKeepTrying), std::system_error) << name;
}

TEST_F(CanSocketTest, NamesAnInterfaceThatIsNotThere) {
  try {
    CanSocket socket("vcan77");
    FAIL() << "opened an interface that does not exist";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("vcan77"), std::string::npos);
  }
}

}  // namespace
}  // namespace earshot::host
