#pragma once

#include <compare>
#include <cstdint>

namespace earshot {

/// A span of time, whole microseconds.
struct Duration {
  std::int64_t us = 0;

  static constexpr Duration seconds(std::int64_t s) { return {s * 1'000'000}; }
  static constexpr Duration milliseconds(std::int64_t ms) { return {ms * 1'000}; }
  [[nodiscard]] constexpr double to_seconds() const { return static_cast<double>(us) * 1e-6; }
  friend constexpr auto operator<=>(Duration, Duration) = default;
  friend constexpr Duration operator+(Duration a, Duration b) { return {a.us + b.us}; }
  friend constexpr Duration operator-(Duration a, Duration b) { return {a.us - b.us}; }
};

/// An instant on the mission clock: microseconds since an epoch that the shell chooses (UTC at sea, mission start in simulation).
struct Time {
  std::int64_t us = 0;

  friend constexpr auto operator<=>(Time, Time) = default;
  friend constexpr Duration operator-(Time a, Time b) { return {a.us - b.us}; }
  friend constexpr Time operator+(Time a, Duration d) { return {a.us + d.us}; }
};

/// Whether a date that a sender gave, any number at all, is not negative and no further than `most` from `now`, before or after.
/// @param now  not negative
[[nodiscard]] constexpr bool lies_within(Time date, Time now, Duration most) {
  return date.us >= 0 && date - now <= most && now - date <= most;
}

}  // namespace earshot
