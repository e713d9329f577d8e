#include "firmware/host/mission/port_settings.hpp"

#include <algorithm>
#include <stdexcept>

#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::host {
namespace {

/// Of a CAN port, or one whose address is refused anyway: none.
std::optional<LcmUrl> lcm_url_of(const PortSettings& port) {
  try {
    if (port.kind == PortKind::kLcm) return parse_lcm_url(port.address);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

bool are_on_one_bus(const PortSettings& a, const PortSettings& b) {
  if (a.kind == PortKind::kCan) return b.kind == PortKind::kCan && a.address == b.address;
  const std::optional<LcmUrl> url_a = lcm_url_of(a);
  const std::optional<LcmUrl> url_b = lcm_url_of(b);
  return url_a && url_b && url_a->group == url_b->group && url_a->port == url_b->port;
}

bool is_sound_on_bus(const PortSettings& a, const PortSettings& b) {
  return (a.roles.has(Role::kHydrophone) || b.roles.has(Role::kHydrophone)) && are_on_one_bus(a, b);
}

bool has_port_for(std::span<const PortSettings> ports, Role role) {
  return std::any_of(ports.begin(), ports.end(), [role](const PortSettings& port) { return port.roles.has(role); });
}

std::vector<std::string> addresses_of(std::span<const PortSettings> ports, PortKind kind) {
  std::vector<std::string> addresses;
  for (const PortSettings& port : ports) {
    if (port.kind == kind && std::find(addresses.begin(), addresses.end(), port.address) == addresses.end())
      addresses.push_back(port.address);
  }
  return addresses;
}

}  // namespace earshot::host
