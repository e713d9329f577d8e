#pragma once

#include <cstdint>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/runtime/outputs.hpp"
#include "firmware/runtime/progress.hpp"

namespace earshot::runtime {

/// A second copy of what decides about the vehicle, to find a flipped bit in either. Owns the copy of the mission and of its progress, and
/// the mark that the memory can be trusted: once it cannot, it never can again.
/// Oracle: ShadowCopy.*, MemoryFault.*
class ShadowCopy {
 public:
  /// The memory is trusted again: all in it is new.
  void trust(const config::Mission& mission, const Progress& progress);
  void copy(const config::Mission& mission);
  void copy(const Progress& progress);

  /// What differs from its copy, by the bytes, is trusted no more; nor is anything once the mark itself has changed.
  void compare(const config::Mission& mission);
  void compare(const Progress& progress);
  /// Damage was found elsewhere.
  void distrust() { mark_ = 0; }
  [[nodiscard]] bool is_trusted() const { return mark_ == kIntact; }

  /// What is left to say when the memory cannot be trusted: the mission has ended, and a vehicle that was commanded comes up.
  void bring_up(Time now, const config::Mission& mission, const Progress& progress, Outputs& outputs) const;

 private:
  /// Any other number: the memory was found damaged.
  static constexpr std::uint64_t kIntact = 0x5A3C'96E1'0F78'B42DU;

  // In this order: a copy that lies a multiple of 4 KiB behind what it is of costs a desktop processor a tenth of a turn.
  Progress progress_;
  config::Mission mission_;
  std::uint64_t mark_ = kIntact;
};

}  // namespace earshot::runtime
