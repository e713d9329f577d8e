#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace earshot::hil {

// What this kernel has counted, by iproute2. Nothing, where it does not say.

/// Times that an interface's CAN controller came into these states.
struct ControllerCounts {
  std::uint64_t error_passive = 0;
  std::uint64_t bus_off = 0;
};
[[nodiscard]] std::optional<ControllerCounts> controller_counts(const std::string& interface);

/// Frames that went through an interface's netem.
struct NetemCounts {
  std::uint64_t passed = 0;
  std::uint64_t dropped = 0;
};
[[nodiscard]] std::optional<NetemCounts> netem_counts(const std::string& interface);

/// Sets what an interface does to what it sends, as `tc qdisc replace dev INTERFACE root netem HOW` does.
/// @param how  empty: nothing any more   @return false: this kernel has no netem, or we are not root, or that is nothing that netem does
[[nodiscard]] bool set_netem(const std::string& interface, const std::string& how);

}  // namespace earshot::hil
