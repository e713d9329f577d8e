#include "firmware/host/mission/ports/port_override.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/authority_table.hpp"
#include "firmware/host/mission/n2k_table.hpp"
#include "firmware/host/transport/interface_name.hpp"
#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::host {
namespace {

/// Every role over LCM.
PortSettings lcm_port() {
  return {.name = "lcm",
          .kind = PortKind::kLcm,
          .address = std::string(kDefaultLcmUrl),
          .roles = {Role::kNavigation, Role::kSnr, Role::kOperator, Role::kAutopilot, Role::kStatus}};
}

/// Every role over CAN, as the device that the mission's own CAN port is, if it has one.
PortSettings can_port(const MissionFile& file) {
  const auto own = std::ranges::find(file.ports, PortKind::kCan, &PortSettings::kind);
  return {.name = "can",
          .kind = PortKind::kCan,
          .address = kDefaultCanInterface,
          .roles = kCanRoles,
          .n2k = own != file.ports.end() ? own->n2k : default_n2k(file.mission.navigation_timeout)};
}

std::vector<PortSettings> ports_named(const std::string& bus, const MissionFile& file) {
  if (bus == "lcm") return {lcm_port()};
  if (bus == "can") return {can_port(file)};
  PortSettings sensors = can_port(file);
  sensors.roles = {Role::kNavigation};
  PortSettings rest = lcm_port();
  rest.roles = {Role::kSnr, Role::kOperator, Role::kAutopilot, Role::kStatus};
  return {sensors, rest};
}

}  // namespace

void override_ports(MissionFile& file, const PortOverride& given) {
  if (given.can_interface && !is_interface_name(*given.can_interface))
    throw BadInput("--can-interface \"" + printable(*given.can_interface) + "\": " + kInterfaceNameRule);
  if (given.bus) {
    std::vector<PortSettings> ports = ports_named(*given.bus, file);
    std::ranges::copy_if(file.ports, std::back_inserter(ports), [](const PortSettings& port) { return port.roles.has(Role::kHydrophone); });
    file.ports = std::move(ports);
    give_command_proof(file);
  }
  for (PortSettings& port : file.ports) {
    const std::optional<std::string>& over_lcm = port.roles.has(Role::kHydrophone) ? given.hydrophone_url : given.lcm_url;
    const std::optional<std::string>& address = port.kind == PortKind::kCan ? given.can_interface : over_lcm;
    if (address) port.address = *address;
  }
  const char* const option = given.hydrophone_url ? "--hydrophone-url" : "--lcm-url";
  for (const PortSettings& port : file.ports) {
    for (const PortSettings& other : file.ports) {
      if (&port != &other && is_sound_on_bus(port, other))
        throw BadInput(std::string(option) + " \"" + other.address + "\": port \"" + port.name + "\" is there already: " + kSoundOnBus);
    }
  }
}

void leave_out_hydrophones(MissionFile& file) {
  std::erase_if(file.ports, [](const PortSettings& port) { return port.roles.has(Role::kHydrophone); });
}

void leave_snr_to_simulator(MissionFile& file) {
  for (PortSettings& port : file.ports) {
    if (port.kind == PortKind::kCan) port.roles.remove(Role::kSnr);
    port.snr_is_simulators = port.kind == PortKind::kLcm;  // the role stays: a hydrophone's status comes by it
  }
}

}  // namespace earshot::host
