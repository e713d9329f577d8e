#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/can/filter.hpp"

namespace earshot::host {

/// What a socket asks of the kernel.
struct CanOptions {
  CanFilters filters;  ///< none: every frame, also such as are not NMEA 2000
  /// Frames that may wait to be read; 1 s of a full bus of 1 Mbit/s unless told.
  std::size_t room_frames = config::kCanReceiveRoomFrames;
};

/// A frame that waits counts as this much in the kernel, whatever it holds: its buffer, and the kernel's own remarks.
/// Oracle: CanLoad.AFrameThatWaitsCostsTheKernelNoMoreThanSaid
inline constexpr std::size_t kFrameInKernel_bytes = 1024;

/// A socket on the interface; on failure none, errno, and the call that failed. Allocates nothing.
[[nodiscard]] FileDescriptor open_raw_can(const std::string& interface, const CanOptions& options, const char*& failed);
/// What `failed` points to when there is no such interface.
extern const char* const kInterfaceNotFound;

/// @return false: see errno
[[nodiscard]] bool set_filters(int socket, const CanFilters& filters);

/// Frames that may wait to be read, as the kernel granted it: what an unprivileged process may ask for ends at sysctl net.core.rmem_max.
[[nodiscard]] std::size_t room_frames(int socket);

/// Index of the interface if it is there and up, else 0; asked through any socket.
[[nodiscard]] int index_if_up(int asking, const std::string& interface);
/// Whether it has a carrier: the kernel takes it from an interface whose controller is bus-off.
[[nodiscard]] bool has_carrier(int asking, const std::string& interface);

}  // namespace earshot::host
