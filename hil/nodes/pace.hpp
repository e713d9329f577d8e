#pragma once

#include "firmware/core/time.hpp"

namespace earshot::hil {

/// When something that comes with a period is due. Times that were missed are not made up for: whoever is late goes on from there.
class Pace {
 public:
  /// @param period  > 0
  explicit Pace(Duration period) : period_(period) {}

  /// Whether it is due now; then the next time is a period later.
  [[nodiscard]] bool is_due(Time now) {
    if (has_begun_ && now < next_) return false;
    const bool is_on_time = has_begun_ && now - next_ < period_;
    next_ = (is_on_time ? next_ : now) + period_;
    has_begun_ = true;
    return true;
  }

 private:
  Duration period_;
  bool has_begun_ = false;  ///< before, it is due at once
  Time next_;
};

}  // namespace earshot::hil
