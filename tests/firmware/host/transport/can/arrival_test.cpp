#include "firmware/host/transport/can/arrival.hpp"

#include <gtest/gtest.h>
#include <linux/errqueue.h>
#include <linux/net_tstamp.h>
#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <optional>

namespace earshot::host {
namespace {

constexpr Time kSoftware{1'800'000'000'000'000};  // a day in 2027

TEST(CanArrival, IsTheControllersOwnWhereItsClockIsTheHosts) {
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us - 250}), Time{kSoftware.us - 250});
  EXPECT_EQ(arrival_of(kSoftware, kSoftware), kSoftware);
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us - 100'000}), Time{kSoftware.us - 100'000});
}

TEST(CanArrival, IsTheKernelsWhereTheControllerCountsFromWhenItWasSwitchedOnOrInAtomicTimeOrDrifts) {
  EXPECT_EQ(arrival_of(kSoftware, Time{73'000'000}), kSoftware);
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us + 37'000'000}), kSoftware);
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us + 1}), kSoftware) << "the controller cannot have had it later";
  EXPECT_EQ(arrival_of(kSoftware, Time{kSoftware.us - 100'001}), kSoftware);
}

/// What a kernel says about a frame, as recvmsg gives it.
std::optional<Time> arrival_with(timespec software, timespec hardware) {
  alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(scm_timestamping))> control{};
  msghdr message{};
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  cmsghdr* part = CMSG_FIRSTHDR(&message);
  *part = {.cmsg_len = CMSG_LEN(sizeof software), .cmsg_level = SOL_SOCKET, .cmsg_type = SCM_TIMESTAMPNS};
  std::memcpy(CMSG_DATA(part), &software, sizeof software);
  part = CMSG_NXTHDR(&message, part);
  scm_timestamping stamps{};
  stamps.ts[2] = {hardware.tv_sec, hardware.tv_nsec};
  *part = {.cmsg_len = CMSG_LEN(sizeof stamps), .cmsg_level = SOL_SOCKET, .cmsg_type = SCM_TIMESTAMPING};
  std::memcpy(CMSG_DATA(part), &stamps, sizeof stamps);
  return arrival_of(message);
}

TEST(CanArrival, IsReadFromWhatTheKernelSaysAboutAFrame) {
  EXPECT_EQ(arrival_with({1'800'000'000, 250'000'000}, {1'800'000'000, 249'000'000}), Time{1'800'000'000'249'000});
  EXPECT_EQ(arrival_with({1'800'000'000, 250'000'999}, {0, 0}), Time{1'800'000'000'250'000});
}

TEST(CanArrival, IsNoneWhereTheKernelStampsNothing) {
  EXPECT_EQ(arrival_with({0, 0}, {0, 0}), std::nullopt);
}

TEST(CanArrival, IsNeverTheControllersAlone) {
  EXPECT_EQ(arrival_of(std::nullopt, kSoftware), std::nullopt);
  EXPECT_EQ(arrival_of(kSoftware, std::nullopt), kSoftware);
}

}  // namespace
}  // namespace earshot::host
