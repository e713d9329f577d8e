#include "firmware/boards/linux/can_socket.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
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

/// How many frames the kernel has dropped on this socket so far, as it says beside every frame; `known` if it does not say.
std::uint64_t drop_count(msghdr& header, std::uint64_t known) {
  for (cmsghdr* control = CMSG_FIRSTHDR(&header); control != nullptr; control = CMSG_NXTHDR(&header, control)) {
    if (control->cmsg_level == SOL_SOCKET && control->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t count = 0;
      std::memcpy(&count, CMSG_DATA(control), sizeof count);
      return count;
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
  return receive(frame, budget);
}

Status CanSocket::receive(n2k::Frame& frame, std::size_t& budget) {
  for (; budget > 0; --budget) {
    can_frame in{};
    iovec piece{&in, sizeof in};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(std::uint32_t))> control{};
    msghdr header{};
    header.msg_iov = &piece;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    if (::recvmsg(socket_.number(), &header, 0) != sizeof in) return Status::kNotReady;
    counters_.lost_by_kernel = drop_count(header, counters_.lost_by_kernel);
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
