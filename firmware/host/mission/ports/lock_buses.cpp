#include "firmware/host/mission/ports/lock_buses.hpp"

#include <string>

namespace earshot::host {

std::vector<BusLock> lock_buses(const MissionFile& mission, BusPlace place) {
  std::vector<BusLock> locks;
  for (const std::string& url : addresses_of(mission.ports, PortKind::kLcm)) locks.push_back(lock_lcm(url, place));
  for (const std::string& interface : addresses_of(mission.ports, PortKind::kCan)) locks.push_back(lock_can(interface, place));
  return locks;
}

std::vector<BusLock> lock_buses_at_sea(const MissionFile& mission, const std::filesystem::path& folder) {
  std::vector<BusLock> locks;
  for (const std::string& url : addresses_of(mission.ports, PortKind::kLcm)) locks.push_back(lock_lcm_at_sea(url, folder));
  for (const std::string& interface : addresses_of(mission.ports, PortKind::kCan)) locks.push_back(lock_can_at_sea(interface, folder));
  return locks;
}

}  // namespace earshot::host
