#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// Another mission or flight on this machine uses the bus; the message says which bus, and who.
class BusInUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Places on a bus. A mission at sea takes all of them; the halves of a simulated flight take one each, and who starts both holds the
/// third, so that the halves need not know whether they were started by hand.
enum class BusPlace : std::uint8_t { kFlight, kVehicle, kSimulator };
inline constexpr std::size_t kBusPlaces = 3;

// A bus carries one mission at a time: two would take each other's navigation and set-points for their own. Whoever opens a bus holds the
// lock of it. It is the name of a local socket in Linux's abstract namespace rather than a file: the kernel frees it with the process
// however that ends, no other user's left-over file can be in the way, and like the buses themselves it belongs to one network namespace.

/// Held as long as it is kept.
class BusLock {
 public:
  BusLock() = default;
  ~BusLock() = default;
  // Not inline: where it is, GCC 12 at -O3 takes the moved array for one of size zero (-Wstringop-overflow).
  BusLock(BusLock&& other) noexcept;
  BusLock& operator=(BusLock&& other) noexcept;
  BusLock(const BusLock&) = delete;
  BusLock& operator=(const BusLock&) = delete;

  /// Leaves vehicle and simulator to the processes that are about to be started, and stays in its own place.
  void leave_to_children();

  /// Who else has the name of the bus, and is not heeded; empty: nobody.
  [[nodiscard]] const std::string& stranger() const { return stranger_; }

 private:
  friend class BusName;
  std::array<FileDescriptor, kBusPlaces> places_;
  FileDescriptor file_;  ///< at sea
  std::string stranger_;
};

/// All places: nobody is on the bus yet. URLs of one group and port are one bus, whatever their options.
/// @throws BusInUse, std::invalid_argument as parse_lcm_url does, std::system_error.
[[nodiscard]] BusLock lock_lcm(std::string_view url);
/// One place.
[[nodiscard]] BusLock lock_lcm(std::string_view url, BusPlace place);

/// All places, at sea. Anybody on this computer can take the name of a bus and keep a vehicle ashore, or a search from going on: one that
/// is held by another user, who is not root, refuses nobody. Among a service's own missions a file in its folder does, which is nobody
/// else's.
/// @param folder  RUNTIME_DIRECTORY; empty: there is none
[[nodiscard]] BusLock lock_lcm_at_sea(std::string_view url, const std::filesystem::path& folder);

/// The same for a CAN interface.
[[nodiscard]] BusLock lock_can(std::string_view interface);
[[nodiscard]] BusLock lock_can(std::string_view interface, BusPlace place);
[[nodiscard]] BusLock lock_can_at_sea(std::string_view interface, const std::filesystem::path& folder);

}  // namespace earshot::host
