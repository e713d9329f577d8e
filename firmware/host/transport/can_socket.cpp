#include "firmware/host/transport/can_socket.hpp"

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
#include <utility>

#include "firmware/config/capacities.hpp"
#include "firmware/host/transport/interface_name.hpp"

namespace earshot::host {

namespace {

[[noreturn]] void fail(const std::string& interface, const char* call) {
  throw std::system_error(errno, std::generic_category(), "CAN interface " + interface + ": " + call);
}

/// When the kernel received the message, as it says beside it; none if it does not say.
Time received_utc_of(msghdr& header) {
  for (cmsghdr* control = CMSG_FIRSTHDR(&header); control != nullptr; control = CMSG_NXTHDR(&header, control)) {
    if (control->cmsg_level != SOL_SOCKET || control->cmsg_type != SCM_TIMESTAMP) continue;
    timeval received{};
    std::memcpy(&received, CMSG_DATA(control), sizeof received);
    return Time{received.tv_sec * std::int64_t{1'000'000} + received.tv_usec};
  }
  return Time{-1};
}

constexpr const char* kNotFound = "not found";

/// A socket on the interface; on failure no socket, errno, and the call that failed.
FileDescriptor try_to_open(const std::string& interface, const char*& failed) {
  FileDescriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  failed = "this kernel has no SocketCAN";
  if (socket.number() < 0) return {};
  failed = kNotFound;
  const unsigned index = ::if_nametoindex(interface.c_str());
  if (index == 0) return {};
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  const int on = 1;
  failed = "SO_TIMESTAMP";
  if (::setsockopt(socket.number(), SOL_SOCKET, SO_TIMESTAMP, &on, sizeof on) != 0) return {};
  failed = "bind";
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return {};
  return socket;
}

/// Index of the interface if it is there and up, else 0; asked through any socket.
int index_if_up(int asking, const std::string& interface) {
  ifreq request{};
  interface.copy(request.ifr_name, sizeof request.ifr_name - 1);
  if (::ioctl(asking, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) return 0;
  return ::ioctl(asking, SIOCGIFINDEX, &request) == 0 ? request.ifr_ifindex : 0;
}

bool means_nothing_yet(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

CanSocket::CanSocket(const std::string& interface, IfMissing if_missing) : interface_(interface) {
  if (!is_interface_name(interface)) {
    errno = EINVAL;
    fail(interface, kInterfaceNameRule);
  }
  const char* failed = nullptr;
  socket_ = try_to_open(interface, failed);
  is_up_ = socket_.number() >= 0;
  if (!is_up_ && (failed != kNotFound || if_missing == IfMissing::kRefuse)) fail(interface, failed);
  index_ = static_cast<int>(::if_nametoindex(interface.c_str()));
}

void CanSocket::note_error() {
  ++counters_.errors;
  is_up_ = index_if_up(socket_.number(), interface_) == index_;  // another of that name is not the one that the socket is bound to
}

bool CanSocket::reopen() {
  const char* failed = nullptr;
  FileDescriptor socket = try_to_open(interface_, failed);
  const int index = socket.number() < 0 ? 0 : index_if_up(socket.number(), interface_);
  if (index == 0) return is_up_ = false;
  index_ = index;
  (void)drops_.count(socket_.number());
  socket_ = std::move(socket);
  drops_.restart();
  return is_up_ = true;
}

CanCounters CanSocket::counters() const {
  CanCounters counters = counters_;
  counters.lost_by_kernel = drops_.count(socket_.number());
  return counters;
}

Status CanSocket::send(const n2k::Frame& frame) {
  if (socket_.number() < 0) {
    ++counters_.send_failed;
    return Status::kFull;
  }
  can_frame out{};
  out.can_id = (frame.identifier & CAN_EFF_MASK) | CAN_EFF_FLAG;
  out.can_dlc = std::min<std::uint8_t>(frame.size, CAN_MAX_DLEN);
  std::copy_n(frame.data.begin(), out.can_dlc, out.data);
  if (::send(socket_.number(), &out, sizeof out, 0) != sizeof out) {
    ++counters_.send_failed;
    if (!means_nothing_yet(errno) && errno != ENOBUFS) note_error();
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
  if (socket_.number() < 0) return Status::kNotReady;
  for (; budget > 0; --budget) {
    can_frame in{};
    iovec piece{&in, sizeof in};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timeval))> control{};
    msghdr header{};
    header.msg_iov = &piece;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    const ssize_t size = ::recvmsg(socket_.number(), &header, 0);
    if (size < 0 && !means_nothing_yet(errno)) note_error();
    if (size != sizeof in) return Status::kNotReady;
    received_utc = received_utc_of(header);
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

}  // namespace earshot::host
