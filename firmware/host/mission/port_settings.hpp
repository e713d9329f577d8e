#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

namespace earshot::host {

/// What a port of the vehicle is for; each role may have several ports.
enum class Role : std::uint8_t {
  kNavigation,  ///< brings where the vehicle is
  kSnr,         ///< brings what the hydrophone measures
  kOperator,    ///< brings orders, takes their acknowledgements
  kAutopilot,   ///< takes set-points
  kStatus,      ///< takes decisions and health
  kHydrophone,  ///< brings sound, on a bus of its own: no role goes with it
};
inline constexpr std::size_t kRoleCount = 6;

class Roles {
 public:
  constexpr Roles() = default;
  constexpr Roles(std::initializer_list<Role> roles) {
    for (const Role role : roles) add(role);
  }
  constexpr void add(Role role) { bits_ = static_cast<std::uint8_t>(bits_ | bit(role)); }
  [[nodiscard]] constexpr bool has(Role role) const { return (bits_ & bit(role)) != 0; }
  friend constexpr bool operator==(Roles, Roles) = default;

 private:
  static constexpr std::uint8_t bit(Role role) { return static_cast<std::uint8_t>(1U << static_cast<unsigned>(role)); }
  std::uint8_t bits_ = 0;
};

enum class PortKind : std::uint8_t { kLcm, kCan };

/// What a CAN port can carry so far.
inline constexpr Roles kCanRoles{Role::kNavigation, Role::kAutopilot};

/// A port as the mission file describes it.
struct PortSettings {
  std::string name;
  PortKind kind = PortKind::kLcm;
  std::string address;  ///< LCM URL or CAN interface
  Roles roles;
};

}  // namespace earshot::host
