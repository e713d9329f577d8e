#include "hil/bench/at_sea/wall_clock.hpp"

#include <cerrno>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace earshot::hil {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// @return whether the kernel took it
bool set_by(std::int64_t ahead_ns) {
  timespec now{};
  if (::clock_gettime(CLOCK_REALTIME, &now) != 0) return false;
  const std::int64_t then_ns = now.tv_sec * kSecond_ns + now.tv_nsec + ahead_ns;
  const timespec then{.tv_sec = then_ns / kSecond_ns, .tv_nsec = then_ns % kSecond_ns};
  return ::clock_settime(CLOCK_REALTIME, &then) == 0;
}

}  // namespace

bool has_clock_of_its_own() {
  std::ifstream file("/proc/cpuinfo");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  return text.find("User Mode Linux") != std::string::npos;
}

WallClockAhead::WallClockAhead(double seconds) : ahead_ns_(std::llround(seconds * static_cast<double>(kSecond_ns))) {
  if (!set_by(ahead_ns_)) throw std::system_error(errno, std::generic_category(), "the wall clock cannot be set");
}

WallClockAhead::~WallClockAhead() {
  (void)set_by(-ahead_ns_);
}

}  // namespace earshot::hil
