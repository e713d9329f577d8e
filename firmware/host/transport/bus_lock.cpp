#include "firmware/host/transport/bus_lock.hpp"

#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::host {
namespace {

/// @param key  the bus, the same text for all who mean the same bus
FileDescriptor lock(const std::string& key, const std::string& bus) {
  const std::string name = "earshot-bus " + key;
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  if (name.size() >= sizeof(address.sun_path)) throw std::system_error(ENAMETOOLONG, std::generic_category(), bus);
  std::copy(name.begin(), name.end(), address.sun_path + 1);  // a first byte of zero: the abstract namespace
  FileDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (socket.number() < 0) throw std::system_error(errno, std::generic_category(), bus + ": socket");
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), length) == 0) return socket;
  if (errno == EADDRINUSE) throw BusInUse(bus + ": another mission or flight on this machine is using it");
  throw std::system_error(errno, std::generic_category(), bus + ": bind");
}

}  // namespace

FileDescriptor lock_lcm(std::string_view url) {
  const LcmUrl parsed = parse_lcm_url(url);
  return lock("lcm " + std::to_string(parsed.group) + ":" + std::to_string(parsed.port), std::string(url));
}

FileDescriptor lock_can(std::string_view interface) {
  return lock("can " + std::string(interface), "CAN interface " + std::string(interface));
}

}  // namespace earshot::host
