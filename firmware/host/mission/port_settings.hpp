#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/mission/authority/command_proof.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"

namespace earshot::host {

/// What a port of the vehicle is for; each role may have several ports.
enum class Role : std::uint8_t {
  kNavigation,  ///< brings where the vehicle is, and how it is
  kSnr,         ///< brings what the hydrophone measures, and how it is
  kOperator,    ///< brings orders, takes their acknowledgements
  kAutopilot,   ///< takes set-points, brings how the autopilot is
  kStatus,      ///< takes decisions, health and what the safety supervisor does
  kHydrophone,  ///< brings sound, on a bus of its own: no role goes with it
};
inline constexpr std::size_t kRoleCount = 6;
/// In the order of Role.
inline constexpr std::array<const char*, kRoleCount> kRoleWords{"navigation", "snr", "operator", "autopilot", "status", "hydrophone"};

class Roles {
 public:
  constexpr Roles() = default;
  constexpr Roles(std::initializer_list<Role> roles) {
    for (const Role role : roles) add(role);
  }
  constexpr void add(Role role) { bits_ = static_cast<std::uint8_t>(bits_ | bit(role)); }
  constexpr void remove(Role role) { bits_ = static_cast<std::uint8_t>(bits_ & ~bit(role)); }
  [[nodiscard]] constexpr bool has(Role role) const { return (bits_ & bit(role)) != 0; }
  friend constexpr bool operator==(Roles, Roles) = default;

 private:
  static constexpr std::uint8_t bit(Role role) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(role)); }
  std::uint8_t bits_ = 0;
};

enum class PortKind : std::uint8_t { kLcm, kCan };

/// What a CAN port can carry: all but sound.
inline constexpr Roles kCanRoles{Role::kNavigation, Role::kSnr, Role::kOperator, Role::kAutopilot, Role::kStatus};

/// Which device a CAN port is on its NMEA 2000 bus, and what it believes of the others.
struct N2kSettings {
  std::uint8_t address = n2k::kRuntimeAddress;  ///< claimed first, 0 to 251
  std::uint32_t unique_number = 1;              ///< of its NAME, 21 bits: no two Earshots on a bus may have the same
  std::uint8_t device_instance = 0;             ///< of its NAME
  n2k::NavigationSettings navigation;
  n2k::SourceChoice snr_source;
  n2k::SourceChoice autopilot_source;     ///< of the status
  bool zero_pressure_at_surface = false;  ///< with the START that is obeyed, if the vehicle is at the surface then
};

/// A port as the mission file describes it.
struct PortSettings {
  std::string name;
  PortKind kind = PortKind::kLcm;
  std::string address;  ///< LCM URL or CAN interface
  Roles roles;
  N2kSettings n2k = {};                                      ///< of a CAN port
  std::optional<CommandProof> command_proof = std::nullopt;  ///< of a port that brings orders, where the mission names a key
  bool snr_is_simulators = false;  ///< of an LCM port: an SNR that comes by it is a stranger's, and counts for nothing
};

[[nodiscard]] bool has_port_for(std::span<const PortSettings> ports, Role role);
/// The addresses of all ports of one kind, each once.
[[nodiscard]] std::vector<std::string> addresses_of(std::span<const PortSettings> ports, PortKind kind);

/// Whether what one is sent the other must read, too. Options of a URL make no other bus.
[[nodiscard]] bool are_on_one_bus(const PortSettings& a, const PortSettings& b);
/// Two ports on one bus of which one brings sound.
[[nodiscard]] bool is_sound_on_bus(const PortSettings& a, const PortSettings& b);
/// What is wrong with that.
inline constexpr const char* kSoundOnBus =
    "a hydrophone needs a group or port of its own, so that its samples cannot crowd out navigation and orders";

}  // namespace earshot::host
