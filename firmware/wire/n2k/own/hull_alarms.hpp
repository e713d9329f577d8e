#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"

namespace earshot::n2k {

/// Which of the devices that watch a hull have water or a ground fault. Every one counts, as compartments have their own; and what one has
/// said holds until the same one (by its NAME, once that is known, and its instance) takes it back: one that is silent, or says that it
/// does not know any more, has not become dry.
class HullAlarms {
 public:
  /// @param source  the address that it was said from
  void take(const Hull& hull, std::uint8_t source, const Directory& directory);

  [[nodiscard]] bool has_leak() const;
  [[nodiscard]] bool has_ground_fault() const;

 private:
  struct Alarm {
    std::uint8_t source = kNullAddress;
    std::optional<Name> name;
    std::optional<std::uint8_t> instance;
    bool wet = false;
    bool ground_fault = false;
    [[nodiscard]] bool is_over() const { return !wet && !ground_fault; }
  };
  [[nodiscard]] static bool is_of(const Alarm& alarm, const Alarm& other);
  [[nodiscard]] Alarm& place_of(const Alarm& alarm);

  std::array<Alarm, config::kHullAlarms> alarms_{};
  Alarm unplaced_;  ///< of those that found no place; nobody takes it back
};

}  // namespace earshot::n2k
