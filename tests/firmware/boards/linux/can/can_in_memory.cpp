// A CAN bus for a program that is linked with this file: its sockets of the family PF_CAN are on one bus, vcan0, which is always up and
// needs no kernel that has SocketCAN. What a program calls of the kernel for them stands here in place of the C library's; every other
// socket goes to the kernel as ever. Not of a bus: errors, its load, an interface that goes down (hil/bus/with-can has those).
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <ctime>
#include <string_view>
#include <vector>

namespace {

constexpr std::string_view kOnlyInterface = "vcan0";
constexpr int kItsIndex = 1;

struct CanSocket {
  int number;     ///< the program's
  int other_end;  ///< what is written here, the program reads
  bool is_bound = false;
  std::vector<can_filter> filters{can_filter{}};  ///< as the kernel has it: the first lets every frame through
};

/// On its way with its arrival.
struct Packet {
  can_frame frame;
  timespec arrival;
};

std::vector<CanSocket> sockets;

CanSocket* find(int number) {
  const auto found = std::ranges::find(sockets, number, &CanSocket::number);
  return found == sockets.end() ? nullptr : &*found;
}

bool passes(const CanSocket& socket, const can_frame& frame) {
  return std::ranges::any_of(socket.filters, [&](const can_filter& f) { return (frame.can_id & f.can_mask) == (f.can_id & f.can_mask); });
}

int open_can(int kind) {
  std::array<int, 2> ends{};
  const int flags = kind & (SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (syscall(SYS_socketpair, AF_UNIX, SOCK_SEQPACKET | flags, 0, ends.data()) != 0) return -1;
  sockets.push_back({.number = ends[0], .other_end = ends[1]});
  return ends[0];
}

void stamp(msghdr& message, const timespec& arrival) {
  message.msg_controllen = std::min<std::size_t>(message.msg_controllen, CMSG_SPACE(sizeof arrival));
  cmsghdr* control = CMSG_FIRSTHDR(&message);
  if (control == nullptr) return;
  control->cmsg_level = SOL_SOCKET;
  control->cmsg_type = SCM_TIMESTAMPNS;
  control->cmsg_len = CMSG_LEN(sizeof arrival);
  std::memcpy(CMSG_DATA(control), &arrival, sizeof arrival);
}

}  // namespace

extern "C" {

int socket(int family, int kind, int protocol) noexcept {
  return family == PF_CAN ? open_can(kind) : static_cast<int>(syscall(SYS_socket, family, kind, protocol));
}

int close(int number) {
  if (const CanSocket* can = find(number); can != nullptr) {
    syscall(SYS_close, can->other_end);
    std::erase_if(sockets, [number](const CanSocket& s) { return s.number == number; });
  }
  return static_cast<int>(syscall(SYS_close, number));
}

int setsockopt(int number, int level, int name, const void* value, socklen_t size) noexcept {
  CanSocket* can = find(number);
  if (can == nullptr || level != SOL_CAN_RAW) return static_cast<int>(syscall(SYS_setsockopt, number, level, name, value, size));
  if (name == CAN_RAW_FILTER) {
    const auto* first = static_cast<const can_filter*>(value);
    can->filters.assign(first, first + size / sizeof(can_filter));
  }
  return 0;
}

int bind(int number, const sockaddr* address, socklen_t size) noexcept {
  CanSocket* can = find(number);
  if (can == nullptr) return static_cast<int>(syscall(SYS_bind, number, address, size));
  can->is_bound = true;
  return 0;
}

ssize_t send(int number, const void* data, size_t size, int flags) {
  if (find(number) == nullptr) return syscall(SYS_sendto, number, data, size, flags, nullptr, 0);
  Packet packet{};
  std::memcpy(&packet.frame, data, sizeof packet.frame);
  clock_gettime(CLOCK_REALTIME, &packet.arrival);
  for (const CanSocket& other : sockets) {
    if (other.number == number || !other.is_bound || !passes(other, packet.frame)) continue;
    (void)syscall(SYS_sendto, other.other_end, &packet, sizeof packet, MSG_DONTWAIT | MSG_NOSIGNAL, nullptr, 0);  // full: lost, as on a bus
  }
  return static_cast<ssize_t>(size);
}

ssize_t recvmsg(int number, msghdr* message, int flags) {
  if (find(number) == nullptr) return syscall(SYS_recvmsg, number, message, flags);
  Packet packet{};
  const ssize_t size = syscall(SYS_recvfrom, number, &packet, sizeof packet, flags, nullptr, nullptr);
  if (size < 0) return size;
  std::memcpy(message->msg_iov[0].iov_base, &packet.frame, std::min(message->msg_iov[0].iov_len, sizeof packet.frame));
  message->msg_flags = MSG_DONTROUTE;  // from this computer
  stamp(*message, packet.arrival);
  return sizeof packet.frame;
}

int ioctl(int number, unsigned long request, ...) noexcept {
  va_list more;
  va_start(more, request);
  void* argument = va_arg(more, void*);
  va_end(more);
  if (find(number) == nullptr) return static_cast<int>(syscall(SYS_ioctl, number, request, argument));
  auto& asked = *static_cast<ifreq*>(argument);
  if (asked.ifr_name != kOnlyInterface) {
    errno = ENODEV;
    return -1;
  }
  if (request == SIOCGIFFLAGS) asked.ifr_flags = IFF_UP | IFF_RUNNING;
  if (request == SIOCGIFINDEX) asked.ifr_ifindex = kItsIndex;
  return 0;
}

unsigned if_nametoindex(const char* name) noexcept {
  if (name == kOnlyInterface) return kItsIndex;
  errno = ENODEV;
  return 0;
}

}  // extern "C"
