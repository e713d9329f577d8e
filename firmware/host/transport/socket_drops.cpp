#include "firmware/host/transport/socket_drops.hpp"

#include <linux/sock_diag.h>
#include <sys/socket.h>

#include <array>

namespace earshot::host {

std::uint64_t SocketDrops::count(int socket) const {
  std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
  socklen_t size = sizeof info;
  if (socket < 0 || ::getsockopt(socket, SOL_SOCKET, SO_MEMINFO, info.data(), &size) != 0) return total_;
  total_ += info[SK_MEMINFO_DROPS] - last_;  // modulo 2^32
  last_ = info[SK_MEMINFO_DROPS];
  return total_;
}

}  // namespace earshot::host
