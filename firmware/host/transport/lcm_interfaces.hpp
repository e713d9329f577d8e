#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// The network interfaces of this host that have an IPv4 address and are up. In memory of its own: looking again allocates nothing.
class LcmInterfaces {
 public:
  struct Interface {
    int index = 0;
    std::uint32_t address = 0;  ///< network byte order
    std::array<char, 16> name{};
    bool is_member = false;  ///< of the group of the last join_all()
  };
  static constexpr std::size_t kMost = 32;  ///< IPv4 addresses looked at; more are passed over, counted

  /// @throws std::system_error.
  LcmInterfaces();

  /// Looks again which there are.
  void refresh();
  /// Makes `socket` a member of `group` (network byte order) on every interface on which it is not one yet.
  /// @return on how many interfaces it is a member now
  std::size_t join_all(int socket, std::uint32_t group);
  /// Whether a datagram from this address (network byte order) comes from this host.
  [[nodiscard]] bool is_own(std::uint32_t address) const;
  /// How many addresses or interfaces are not listened on: passed over, or refused by the kernel.
  [[nodiscard]] std::size_t unheard() const;
  /// Those that it is a member on, and what limits the rest: "lo, eth0"; "lo, eth0, but not eth1 (sysctl net.ipv4.igmp_max_memberships),
  /// and not 3 addresses beyond the first 32"; "no interface".
  [[nodiscard]] std::string names() const;

 private:
  [[nodiscard]] std::string names_of(bool members) const;

  FileDescriptor asking_;  ///< any socket: the kernel answers through one
  std::array<Interface, kMost> interfaces_{};
  std::size_t count_ = 0;
  std::size_t passed_over_ = 0;
};

}  // namespace earshot::host
