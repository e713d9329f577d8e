#include "firmware/host/transport/can/raw_socket.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <climits>

#include "firmware/host/transport/can/arrival.hpp"
#include "firmware/host/transport/can/controller.hpp"

namespace earshot::host {

const char* const kInterfaceNotFound = "not found";

namespace {

/// The kernel doubles what it is asked for, for its own remarks; what it answers and holds the waiting frames against is the double.
void ask_for_room(int socket, std::size_t frames) {
  const int half = static_cast<int>(std::min<std::size_t>(frames * kFrameInKernel_bytes / 2, INT_MAX / 2));
  if (::setsockopt(socket, SOL_SOCKET, SO_RCVBUFFORCE, &half, sizeof half) == 0) return;
  (void)::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &half, sizeof half);
}

ifreq request_for(const std::string& interface) {
  ifreq request{};
  interface.copy(request.ifr_name, sizeof request.ifr_name - 1);
  return request;
}

}  // namespace

FileDescriptor open_raw_can(const std::string& interface, const CanOptions& options, const char*& failed) {
  FileDescriptor socket(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
  failed = "this kernel has no SocketCAN";
  if (socket.number() < 0) return {};
  failed = kInterfaceNotFound;
  const unsigned index = ::if_nametoindex(interface.c_str());
  if (index == 0) return {};
  failed = "SO_TIMESTAMPNS";
  if (!ask_for_stamps(socket.number())) return {};
  failed = "CAN_RAW_FILTER";
  if (!set_filters(socket.number(), options.filters)) return {};
  failed = "CAN_RAW_ERR_FILTER";
  const can_err_mask_t errors = CanController::kErrorMask;
  if (::setsockopt(socket.number(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors) != 0) return {};
  ask_for_room(socket.number(), options.room_frames);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  failed = "bind (an interface of another kind than CAN?)";
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return {};
  return socket;
}

bool set_filters(int socket, const CanFilters& filters) {
  static_assert(config::kCanFilters <= CAN_RAW_FILTER_MAX);
  std::array<can_filter, config::kCanFilters> entries{};  // the first as it is lets every frame through
  std::ranges::transform(filters, entries.begin(),
                         [](const CanFilter& filter) { return can_filter{.can_id = filter.identifier, .can_mask = filter.mask}; });
  const auto size = static_cast<socklen_t>(std::max<std::size_t>(filters.size(), 1) * sizeof(can_filter));
  return ::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, entries.data(), size) == 0;
}

std::size_t room_frames(int socket) {
  int bytes = 0;
  socklen_t size = sizeof bytes;
  if (::getsockopt(socket, SOL_SOCKET, SO_RCVBUF, &bytes, &size) != 0) return 0;
  return static_cast<std::size_t>(bytes) / kFrameInKernel_bytes;
}

int index_if_up(int asking, const std::string& interface) {
  ifreq request = request_for(interface);
  if (::ioctl(asking, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) return 0;
  return ::ioctl(asking, SIOCGIFINDEX, &request) == 0 ? request.ifr_ifindex : 0;
}

bool has_carrier(int asking, const std::string& interface) {
  ifreq request = request_for(interface);
  return ::ioctl(asking, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_RUNNING) != 0;
}

}  // namespace earshot::host
