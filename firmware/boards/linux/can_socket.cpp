#include "firmware/boards/linux/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "firmware/config/capacities.hpp"

namespace earshot::board {

namespace {

[[noreturn]] void fail(const std::string& interface, const char* call) {
  throw std::system_error(errno, std::generic_category(), "CAN interface " + interface + ": " + call);
}

/// What the kernel says beside a frame.
struct Remarks {
  std::uint64_t dropped = 0;  ///< frames of this socket so far
  Time received_utc;
};

/// @param known  what stays where the kernel says nothing
Remarks remarks_in(msghdr& header, Remarks known) {
  for (cmsghdr* control = CMSG_FIRSTHDR(&header); control != nullptr; control = CMSG_NXTHDR(&header, control)) {
    if (control->cmsg_level != SOL_SOCKET) continue;
    if (control->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t count = 0;
      std::memcpy(&count, CMSG_DATA(control), sizeof count);
      known.dropped = count;
    } else if (control->cmsg_type == SCM_TIMESTAMP) {
      timeval received{};
      std::memcpy(&received, CMSG_DATA(control), sizeof received);
      known.received_utc = Time{received.tv_sec * std::int64_t{1'000'000} + received.tv_usec};
    }
  }
  return known;
}

}  // namespace

CanSocket::CanSocket(const std::string& interface) : socket_(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW)) {
  if (socket_.number() < 0) fail(interface, "this kernel has no SocketCAN");
  const unsigned index = ::if_nametoindex(interface.c_str());
  if (index == 0) fail(interface, "not found");
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  const int on = 1;
  if (::setsockopt(socket_.number(), SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on) != 0) fail(interface, "SO_RXQ_OVFL");
  if (::setsockopt(socket_.number(), SOL_SOCKET, SO_TIMESTAMP, &on, sizeof on) != 0) fail(interface, "SO_TIMESTAMP");
  if (::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) fail(interface, "bind");
}

Status CanSocket::send(const n2k::Frame& frame) {
  can_frame out{};
  out.can_id = (frame.identifier & CAN_EFF_MASK) | CAN_EFF_FLAG;
  out.can_dlc = std::min<std::uint8_t>(frame.size, CAN_MAX_DLEN);
  std::copy_n(frame.data.begin(), out.can_dlc, out.data);
  if (::send(socket_.number(), &out, sizeof out, 0) != sizeof out) {
    ++counters_.send_failed;
    return Status::kFull;
  }
  ++counters_.sent;
  return Status::kOk;
}

Status CanSocket::receive(n2k::Frame& frame) {
  std::size_t budget = config::kCanFramesPerCollect;
  Time received_utc;
  return receive(frame, received_utc, budget);
}

Status CanSocket::receive(n2k::Frame& frame, Time& received_utc, std::size_t& budget) {
  for (; budget > 0; --budget) {
    can_frame in{};
    iovec piece{&in, sizeof in};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(std::uint32_t)) + CMSG_SPACE(sizeof(timeval))> control{};
    msghdr header{};
    header.msg_iov = &piece;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    if (::recvmsg(socket_.number(), &header, 0) != sizeof in) return Status::kNotReady;
    const Remarks remarks = remarks_in(header, {.dropped = counters_.lost_by_kernel, .received_utc = {}});
    counters_.lost_by_kernel = remarks.dropped;
    received_utc = remarks.received_utc;
    if ((in.can_id & CAN_EFF_FLAG) == 0 || (in.can_id & (CAN_RTR_FLAG | CAN_ERR_FLAG)) != 0 || in.can_dlc > CAN_MAX_DLEN) {
      ++counters_.other_frames;
      continue;
    }
    frame.identifier = in.can_id & CAN_EFF_MASK;
    frame.size = in.can_dlc;
    frame.data.fill(0);
    std::copy_n(in.data, in.can_dlc, frame.data.begin());
    ++counters_.received;
    --budget;
    return Status::kOk;
  }
  return Status::kNotReady;
}

}  // namespace earshot::board
