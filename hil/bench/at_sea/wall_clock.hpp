#pragma once

#include <cstdint>

namespace earshot::hil {

/// Whether this computer's wall clock is nobody else's: user-mode Linux has one of its own.
[[nodiscard]] bool has_clock_of_its_own();

/// The computer's wall clock, so much ahead as long as this lives; its other clocks run on.
class WallClockAhead {
 public:
  /// @throws std::system_error: only root may
  explicit WallClockAhead(double seconds);
  ~WallClockAhead();
  WallClockAhead(const WallClockAhead&) = delete;
  WallClockAhead& operator=(const WallClockAhead&) = delete;

 private:
  std::int64_t ahead_ns_;
};

}  // namespace earshot::hil
