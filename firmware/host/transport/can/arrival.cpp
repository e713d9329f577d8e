#include "firmware/host/transport/can/arrival.hpp"

#include <linux/errqueue.h>
#include <linux/net_tstamp.h>

#include <cstring>
#include <ctime>

namespace earshot::host {

namespace {

std::optional<Time> time_of(const timespec& stamp) {
  if (stamp.tv_sec == 0 && stamp.tv_nsec == 0) return std::nullopt;
  return Time{stamp.tv_sec * std::int64_t{1'000'000} + stamp.tv_nsec / 1000};
}

}  // namespace

std::optional<Time> arrival_of(std::optional<Time> software_utc, std::optional<Time> hardware) {
  if (!software_utc || !hardware) return software_utc;
  const bool is_believed = *hardware <= *software_utc && *software_utc - *hardware <= kEarliestHardwareStamp;
  return is_believed ? hardware : software_utc;
}

bool ask_for_stamps(int socket) {
  const int on = 1;
  // A kernel without it, or a driver: the kernel's stamp alone then.
  const int both = SOF_TIMESTAMPING_RX_HARDWARE | SOF_TIMESTAMPING_RAW_HARDWARE | SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;
  (void)::setsockopt(socket, SOL_SOCKET, SO_TIMESTAMPING, &both, sizeof both);
  return ::setsockopt(socket, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) == 0;
}

std::optional<Time> arrival_of(msghdr& message) {
  std::optional<Time> software;
  std::optional<Time> hardware;
  for (cmsghdr* control = CMSG_FIRSTHDR(&message); control != nullptr; control = CMSG_NXTHDR(&message, control)) {
    if (control->cmsg_level != SOL_SOCKET) continue;
    if (control->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(control), sizeof stamp);
      software = time_of(stamp);
    } else if (control->cmsg_type == SCM_TIMESTAMPING) {
      scm_timestamping stamps{};
      std::memcpy(&stamps, CMSG_DATA(control), sizeof stamps);
      hardware = time_of({.tv_sec = stamps.ts[2].tv_sec, .tv_nsec = stamps.ts[2].tv_nsec});
    }
  }
  return arrival_of(software, hardware);
}

}  // namespace earshot::host
