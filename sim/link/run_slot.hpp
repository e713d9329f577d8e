#pragma once

#include <cstdint>
#include <string>

#include "firmware/host/transport/bus_lock.hpp"
#include "sim/link/session.hpp"

namespace earshot::link {

/// What keeps simulations on one machine apart from each other and from a mission at sea: the lowest number whose LCM bus nobody holds
/// (firmware/host/transport/bus_lock.hpp), and the DDS domain that goes with it. A process takes at most one slot.
class RunSlot {
 public:
  /// Throws LinkError when every slot is taken.
  RunSlot();
  RunSlot(const RunSlot&) = delete;
  RunSlot& operator=(const RunSlot&) = delete;

  [[nodiscard]] std::uint32_t domain() const { return kLowestDomain + number_; }
  /// LCM's customary group; 7668 for the first run, the next ports for others; never 7667, which missions at sea use.
  [[nodiscard]] std::string lcm_url() const;
  /// The run's bus for sound, in a group that no mission at sea uses by custom; it goes with the slot, and is not locked by it.
  [[nodiscard]] std::string hydrophone_url() const;

 private:
  std::uint32_t number_ = 0;
  host::BusLock lock_;
};

}  // namespace earshot::link
