#include "firmware/boards/linux/host_clock.hpp"

#include <chrono>

namespace earshot::board {
namespace {

template <class Clock>
Duration since_its_epoch() {
  return {std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count()};
}

}  // namespace

Time HostClock::utc() const {
  return Time{} + since_its_epoch<std::chrono::system_clock>();
}

Duration HostClock::monotonic() const {
  return since_its_epoch<std::chrono::steady_clock>();
}

}  // namespace earshot::board
