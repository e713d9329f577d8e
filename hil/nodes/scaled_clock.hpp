#pragma once

#include "firmware/core/time.hpp"

namespace earshot::hil {

/// The devices' time: UTC when this is made, and from then on so many times as fast as this host's clock. What sets the wall clock later
/// does not move it.
class ScaledClock {
 public:
  /// @param speed  seconds of the devices per second of the host, > 0
  explicit ScaledClock(double speed);

  [[nodiscard]] Time now() const;
  /// The wall clock's time.
  [[nodiscard]] static Time utc();
  /// The host's clock that does not jump.
  [[nodiscard]] static Time host_now();
  /// How long `duration` of the devices' time takes on the host.
  [[nodiscard]] Duration on_host(Duration duration) const;

 private:
  double speed_;
  Time began_;
  Time began_on_host_;
};

}  // namespace earshot::hil
