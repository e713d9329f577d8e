#include "firmware/host/mission/port_table.hpp"

#include <cstddef>
#include <stdexcept>
#include <string>

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/n2k_table.hpp"
#include "firmware/host/transport/interface_name.hpp"
#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::host {
namespace {

PortSettings read_port(TableReader table, Duration navigation_timeout) {
  PortSettings port;
  port.name = table.text("name");
  if (printable(port.name) != port.name) table.problem("name", "must have no character that steers a terminal");
  port.kind = table.choice("kind", {"lcm", "can"}) == 0 ? PortKind::kLcm : PortKind::kCan;
  for (const std::size_t role : table.choices("roles", {kRoleWords.begin(), kRoleWords.end()})) {
    port.roles.add(static_cast<Role>(role));
    if (port.kind == PortKind::kCan && !kCanRoles.has(static_cast<Role>(role)))
      table.problem("roles", "a CAN port carries no sound: \"hydrophone\" needs a port of kind \"lcm\"");
  }
  if (port.kind == PortKind::kCan) {
    port.address = table.text("interface");
    if (!table.is_noted("interface") && !is_interface_name(port.address)) table.problem("interface", kInterfaceNameRule);
    port.n2k = read_n2k(table.optional_table("n2k"), port.roles, navigation_timeout);
    return port;
  }
  if (port.roles.has(Role::kHydrophone) && port.roles != Roles{Role::kHydrophone})
    table.problem("roles", "\"hydrophone\" needs a port of its own, so that its samples cannot crowd out navigation and orders");
  port.address = table.text("url");
  try {
    if (!port.address.empty()) (void)parse_lcm_url(port.address);
  } catch (const std::invalid_argument& e) {
    table.problem("url", e.what());
  }
  return port;
}

/// What is wrong with a port on the bus of another, whose key stands at `place`.
std::string on_bus_of(const PortSettings& other, const std::string& place, const PortSettings& port) {
  const std::string there = "port \"" + other.name + "\" is there already: ";
  if (is_sound_on_bus(port, other)) return there + kSoundOnBus + " (" + place + ")";
  const char* const why = port.address == other.address ? "" : "; what stands behind the '?' of a URL makes no other bus";
  return there + "give it all roles (" + place + why + ")";
}

}  // namespace

std::vector<PortSettings> read_ports(TableReader root, Duration navigation_timeout) {
  std::vector<PortSettings> ports;
  std::vector<std::string> places;
  for (TableReader table : root.tables("port", config::kMaxPorts - 1)) {
    const PortSettings port = read_port(table, navigation_timeout);
    const char* const key = port.kind == PortKind::kCan ? "interface" : "url";
    for (std::size_t i = 0; i < ports.size(); ++i) {
      const PortSettings& other = ports[i];
      if (port.name == other.name && !table.is_noted("name")) table.problem("name", "\"" + port.name + "\" is another port's name, too");
      if (are_on_one_bus(port, other)) table.problem(key, on_bus_of(other, places[i], port));
    }
    ports.push_back(port);
    places.push_back(table.place_of(key));
  }
  if (ports.empty()) root.problem("port", "a mission needs at least one [[port]]");
  return ports;
}

}  // namespace earshot::host
