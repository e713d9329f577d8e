#pragma once

#include <stdexcept>
#include <string_view>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// Another mission or flight on this machine uses the bus; the message says which bus.
class BusInUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A bus carries one mission at a time: two would take each other's navigation and set-points for their own. Whoever flies holds the lock of
// its bus. It is the name of a local socket in Linux's abstract namespace rather than a file: the kernel frees it with the process however
// that ends, no other user's left-over file can be in the way, and like the buses themselves it belongs to one network namespace.

/// Held as long as the result is kept. URLs of one group and port are one bus, whatever their options.
/// @throws BusInUse, std::invalid_argument as parse_lcm_url does, std::system_error.
[[nodiscard]] FileDescriptor lock_lcm(std::string_view url);

/// The same for a CAN interface.
[[nodiscard]] FileDescriptor lock_can(std::string_view interface);

}  // namespace earshot::host
