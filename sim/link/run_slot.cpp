#include "sim/link/run_slot.hpp"

namespace earshot::link {
namespace {

constexpr std::uint32_t kSlots = kHighestDomain - kLowestDomain + 1;
constexpr std::uint32_t kLowestPort = 7668;  ///< LCM's customary 7667 is left to missions at sea

}  // namespace

RunSlot::RunSlot() {
  for (number_ = 0; number_ < kSlots; ++number_) {
    try {
      lock_ = host::lock_lcm(lcm_url());
      lock_.leave_to_children();
      return;
    } catch (const host::BusInUse&) {
      continue;
    }
  }
  throw LinkError("simulation link: " + std::to_string(kSlots) + " flights are under way on this machine, and there is no room for more");
}

std::string RunSlot::hydrophone_url() const {
  return "udpm://239.255.76.69:" + std::to_string(kLowestPort + number_) + "?ttl=0";
}

std::string RunSlot::lcm_url() const {
  return "udpm://239.255.76.67:" + std::to_string(kLowestPort + number_) + "?ttl=0";
}

}  // namespace earshot::link
