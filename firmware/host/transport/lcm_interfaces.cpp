#include "firmware/host/transport/lcm_interfaces.hpp"

#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <system_error>

namespace earshot::host {
namespace {

constexpr std::uint32_t kLoopbackNet = 127;  // its first byte

bool is_up(int asking, ifreq request) {
  return ::ioctl(asking, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) != 0 &&
         (request.ifr_flags & (IFF_MULTICAST | IFF_LOOPBACK)) != 0;
}

}  // namespace

LcmInterfaces::LcmInterfaces() : asking_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  if (asking_.number() < 0) throw std::system_error(errno, std::generic_category(), "LCM: socket");
  refresh();
}

void LcmInterfaces::refresh() {
  std::array<ifreq, kMost> requests{};
  ifconf list{};  // without room: the kernel says how much it would take
  count_ = passed_over_ = 0;
  if (::ioctl(asking_.number(), SIOCGIFCONF, &list) != 0) return;
  const std::size_t addresses = static_cast<std::size_t>(list.ifc_len) / sizeof(ifreq);
  passed_over_ = addresses - std::min(kMost, addresses);
  list.ifc_len = sizeof requests;
  list.ifc_req = requests.data();
  if (::ioctl(asking_.number(), SIOCGIFCONF, &list) != 0) return;
  const std::size_t found = std::min(kMost, static_cast<std::size_t>(list.ifc_len) / sizeof(ifreq));
  for (ifreq request : std::span(requests).first(found)) {
    sockaddr_in address{};
    std::memcpy(&address, &request.ifr_addr, sizeof address);
    if (address.sin_family != AF_INET || !is_up(asking_.number(), request)) continue;
    Interface& interface = interfaces_[count_];
    interface.address = address.sin_addr.s_addr;
    std::copy_n(request.ifr_name, interface.name.size(), interface.name.begin());
    if (::ioctl(asking_.number(), SIOCGIFINDEX, &request) != 0) continue;
    interface.index = request.ifr_ifindex;
    interface.is_member = false;
    ++count_;
  }
}

std::size_t LcmInterfaces::join_all(int socket, std::uint32_t group) {
  std::size_t joined = 0;
  for (Interface& interface : std::span(interfaces_).first(count_)) {
    ip_mreqn membership{};
    membership.imr_multiaddr.s_addr = group;
    membership.imr_ifindex = interface.index;
    interface.is_member = ::setsockopt(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0 || errno == EADDRINUSE;
    if (interface.is_member) ++joined;
  }
  return joined;
}

bool LcmInterfaces::is_own(std::uint32_t address) const {
  // A host whose only route for multicast is loopback sends without an address; the kernel lets no such datagram in from outside.
  if (address == INADDR_ANY || ntohl(address) >> 24U == kLoopbackNet) return true;
  const auto end = interfaces_.begin() + static_cast<std::ptrdiff_t>(count_);
  return std::any_of(interfaces_.begin(), end, [address](const Interface& i) { return i.address == address; });
}

std::size_t LcmInterfaces::unheard() const {
  const std::span<const Interface> all = std::span(interfaces_).first(count_);
  return passed_over_ + static_cast<std::size_t>(std::ranges::count(all, false, &Interface::is_member));
}

std::string LcmInterfaces::names_of(bool members) const {
  std::string names;
  int last = 0;  // an interface with several addresses stands there several times, one after the other
  for (const Interface& interface : std::span(interfaces_).first(count_)) {
    if (interface.is_member != members || interface.index == last) continue;
    names += (names.empty() ? "" : ", ") + std::string(interface.name.data());
    last = interface.index;
  }
  return names;
}

std::string LcmInterfaces::names() const {
  const std::string heard = names_of(true);
  const std::string refused = names_of(false);
  std::string names = heard.empty() ? "no interface" : heard;
  if (!refused.empty()) names += ", but not " + refused + " (sysctl net.ipv4.igmp_max_memberships)";
  if (passed_over_ > 0) names += ", and not " + std::to_string(passed_over_) + " addresses beyond the first " + std::to_string(kMost);
  return names;
}

}  // namespace earshot::host
