#pragma once

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/can_socket.hpp"

namespace earshot::host {

/// A frame of 127250 from source `source`, told apart by `number`.
inline n2k::Frame heading_frame(std::uint8_t number, std::uint8_t source = 0xCC) {
  return {.identifier = 0x09F11200U | source, .size = 8, .data = {number, 0x70, 0x5A, 0xFF, 0x7F, 0xFF, 0x7F, 0xFD}};
}

/// What iproute2 does. @return whether it was done
inline bool iproute(const std::string& command) {
  return std::system(("PATH=/usr/sbin:/usr/bin:/sbin:/bin; " + command).c_str()) == 0;
}

/// A bus of the test's own, vcan91. Run by hil/bus/with-can, which sets CAN_REQUIRED=1.
class CanBusTest : public ::testing::Test {
 protected:
  static constexpr const char* kBus = "vcan91";

  void SetUp() override {
    const char* required = std::getenv("CAN_REQUIRED");
    const bool is_required = required != nullptr && std::string(required) == "1";
    if (::if_nametoindex("vcan0") == 0) {
      ASSERT_FALSE(is_required) << "CAN_REQUIRED=1, but there is no vcan0";
      GTEST_SKIP() << "no vcan0: run me with hil/bus/with-can";
    }
    ASSERT_TRUE(iproute("ip link add vcan91 type vcan && ip link set vcan91 mtu 72 up"));
  }
  void TearDown() override {
    if (::if_nametoindex(kBus) != 0) {
      EXPECT_TRUE(iproute("ip link del vcan91"));
    }
  }

  static bool wait_for(const CanSocket& socket) {
    pollfd ready{socket.file_descriptor(), POLLIN, 0};
    return ::poll(&ready, 1, 5000) == 1;
  }

  /// What was sent is on its way for a moment where the kernel is busy.
  static bool more_comes(const CanSocket& socket) {
    pollfd ready{socket.file_descriptor(), POLLIN, 0};
    return ::poll(&ready, 1, 50) == 1;
  }

  /// Puts any frame on the bus, also such as no controller would send.
  template <class RawFrame>
  static void put(const RawFrame& frame) {
    const FileDescriptor socket(::socket(PF_CAN, SOCK_RAW, CAN_RAW));
    const int on = 1;
    ASSERT_EQ(::setsockopt(socket.number(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on), 0);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(kBus));
    ASSERT_EQ(::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::send(socket.number(), &frame, sizeof frame, 0), static_cast<ssize_t>(sizeof frame));
  }
  static void put_error(canid_t kind, std::uint8_t problem = 0) {
    can_frame frame{};
    frame.can_id = CAN_ERR_FLAG | kind;
    frame.can_dlc = 8;
    frame.data[1] = problem;
    put(frame);
  }
  /// An error frame read by the socket, which is no message.
  static void give_error(CanSocket& socket, canid_t kind, std::uint8_t problem = 0) {
    put_error(kind, problem);
    ASSERT_TRUE(wait_for(socket));
    n2k::Frame frame;
    ASSERT_EQ(socket.receive(frame), Status::kNotReady);
  }

  /// Frames that the interface has received, as the kernel counts them.
  static std::uint64_t received_by_interface() {
    std::ifstream table("/proc/self/net/dev");
    for (std::string line; std::getline(table, line);) {
      const std::size_t name = line.find("vcan91:");
      if (name == std::string::npos) continue;
      unsigned long long bytes = 0;
      unsigned long long frames = 0;
      if (std::sscanf(line.c_str() + name, "vcan91: %llu %llu", &bytes, &frames) == 2) return frames;
    }
    ADD_FAILURE() << "no vcan91 in /proc/self/net/dev";
    return 0;
  }
};

}  // namespace earshot::host
