#pragma once

#include <ctime>

#include "firmware/core/time.hpp"

namespace earshot::host {

/// A duration, or a time since its clock's beginning, as the kernel takes it: both numbers are as wide as `long` is on this machine.
[[nodiscard]] constexpr timespec timespec_of(Duration duration) {
  constexpr auto kMicrosecondsPerSecond = 1'000'000;
  return {.tv_sec = static_cast<std::time_t>(duration.us / kMicrosecondsPerSecond),
          .tv_nsec = static_cast<decltype(timespec::tv_nsec)>(duration.us % kMicrosecondsPerSecond * 1000)};
}

}  // namespace earshot::host
