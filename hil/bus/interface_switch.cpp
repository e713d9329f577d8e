#include "hil/bus/interface_switch.hpp"

#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <system_error>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::hil {

void switch_interface(const std::string& interface, bool up) {
  const host::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq request{};
  std::copy_n(interface.begin(), std::min(interface.size(), std::size(request.ifr_name) - 1), request.ifr_name);
  bool is_done = ::ioctl(socket.number(), SIOCGIFFLAGS, &request) == 0;
  if (up) {
    request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP);
  } else {
    request.ifr_flags = static_cast<short>(request.ifr_flags & ~IFF_UP);
  }
  is_done = is_done && ::ioctl(socket.number(), SIOCSIFFLAGS, &request) == 0;
  if (!is_done)
    throw std::system_error(errno, std::generic_category(), "the interface " + interface + " cannot be taken " + (up ? "up" : "down"));
}

}  // namespace earshot::hil
