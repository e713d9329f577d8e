#pragma once

#include <sys/socket.h>

#include <optional>

#include "firmware/core/time.hpp"

namespace earshot::host {

/// How long before the kernel's stamp a controller may have stamped a frame, and be believed: interrupts that were held up, and the
/// controller's own queue.
inline constexpr Duration kEarliestHardwareStamp = Duration::milliseconds(100);

/// When a frame arrived, UTC. The kernel's stamp is the host's clock, taken when the driver hands the frame over. The controller's own is
/// better by that delay, but most controllers count from when they were switched on, or in atomic time (37 s ahead): it is believed where
/// it lies before the kernel's by no more than kEarliestHardwareStamp, so that a clock that is no UTC never costs more than that.
/// @return the hardware's if it is believed, else the software's; none if the kernel gave none
[[nodiscard]] std::optional<Time> arrival_of(std::optional<Time> software_utc, std::optional<Time> hardware);

/// Asks for the kernel's stamp, and for the controller's where the kernel can give it. @return false: not even the first; see errno
[[nodiscard]] bool ask_for_stamps(int socket);

/// Room for both stamps beside a message.
struct StampRoom {
  alignas(cmsghdr) char bytes[CMSG_SPACE(2 * sizeof(std::int64_t)) + CMSG_SPACE(6 * sizeof(std::int64_t))];
};

/// What the stamps beside a received message say.
[[nodiscard]] std::optional<Time> arrival_of(msghdr& message);

}  // namespace earshot::host
