#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"

namespace earshot::host {

/// How long nothing is sent after the controller has left the bus: 1 s, and twice as long each time that it leaves it again within a
/// minute, up to 30 s. Whoever goes off the bus may be the one who disturbs it.
class BusOffWait {
 public:
  static constexpr Duration kFirst = Duration::seconds(1);
  static constexpr Duration kLongest = Duration::seconds(30);
  static constexpr Duration kForgottenAfter = Duration::seconds(60);

  void begin(Time now);
  /// @return true once, when the wait is over
  [[nodiscard]] bool ends(Time now);
  [[nodiscard]] bool is_under_way() const { return until_.has_value(); }
  [[nodiscard]] Duration length() const { return length_; }

 private:
  Duration length_{};
  Time began_{};
  std::optional<Time> until_;
  std::optional<Time> ended_;
};

}  // namespace earshot::host
