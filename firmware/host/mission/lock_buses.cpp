#include "firmware/host/mission/lock_buses.hpp"

#include <string>

namespace earshot::host {

std::vector<BusLock> lock_buses(const MissionFile& mission, std::optional<BusPlace> place) {
  std::vector<BusLock> locks;
  for (const std::string& url : addresses_of(mission, PortKind::kLcm)) locks.push_back(place ? lock_lcm(url, *place) : lock_lcm(url));
  for (const std::string& interface : addresses_of(mission, PortKind::kCan))
    locks.push_back(place ? lock_can(interface, *place) : lock_can(interface));
  return locks;
}

}  // namespace earshot::host
