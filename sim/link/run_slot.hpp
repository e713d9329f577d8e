#pragma once

#include <cstdint>
#include <string>

#include "sim/link/session.hpp"

namespace earshot::link {

/// What keeps simulations on one machine apart: the lowest number that no other run holds, and the DDS domain and LCM port that go with it.
/// Held by a lock on a file, which the system releases with the process however it ends. A process takes at most one slot.
class RunSlot {
 public:
  /// Throws LinkError when every slot is taken.
  RunSlot();
  ~RunSlot();
  RunSlot(const RunSlot&) = delete;
  RunSlot& operator=(const RunSlot&) = delete;

  [[nodiscard]] std::uint32_t domain() const { return kLowestDomain + number_; }
  /// LCM's customary group; 7667 for the first run, the next ports for others.
  [[nodiscard]] std::string lcm_url() const;

 private:
  std::uint32_t number_ = 0;
  int file_ = -1;
};

}  // namespace earshot::link
