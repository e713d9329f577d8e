#include "firmware/boards/linux/clock/host_clock.hpp"

#include <ctime>

#include <charconv>
#include <chrono>
#include <cstddef>
#include <fstream>
#include <string>

namespace earshot::board {
namespace {

/// "0b1c61e7-6b43-4a5c-9f0e-2d1f5f3b6a8c"
BootId boot_id_in(const std::string& text) {
  BootId id{};
  std::string digits;
  for (const char c : text)
    if (c != '-') digits += c;
  if (digits.size() != 2 * id.size()) return {};
  for (std::size_t i = 0; i < id.size(); ++i) {
    const char* const begin = digits.data() + 2 * i;
    const auto [end, error] = std::from_chars(begin, begin + 2, id[i], 16);
    if (error != std::errc{} || end != begin + 2) return {};
  }
  return id;
}

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

Duration HostClock::since_boot() const {
  timespec now{};
  (void)::clock_gettime(CLOCK_BOOTTIME, &now);
  return Duration::seconds(now.tv_sec) + Duration{now.tv_nsec / 1000};
}

BootId HostClock::boot() const {
  std::string text;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> text;
  return boot_id_in(text);
}

}  // namespace earshot::board
