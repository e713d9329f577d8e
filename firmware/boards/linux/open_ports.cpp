#include "firmware/boards/linux/open_ports.hpp"

#include <memory>

#include "firmware/boards/linux/can/can_port.hpp"
#include "firmware/boards/linux/hydrophone/hydrophone_port.hpp"
#include "firmware/boards/linux/lcm_port.hpp"

namespace earshot::board {

void open_ports(const host::MissionFile& mission, const HostClock& host, host::IfMissing if_missing, WakesFor wakes, PortSet& ports) {
  for (const host::PortSettings& settings : mission.ports) {
    if (settings.kind == host::PortKind::kCan) {
      ports.add(std::make_unique<CanPort>(ports.next_index(), settings, mission.plane, host, if_missing));
    } else if (settings.roles.has(host::Role::kHydrophone)) {
      ports.add(std::make_unique<HydrophonePort>(ports.next_index(), settings, mission.hearing, wakes, if_missing));
    } else {
      ports.add(std::make_unique<LcmPort>(ports.next_index(), settings, if_missing));
    }
  }
}

}  // namespace earshot::board
