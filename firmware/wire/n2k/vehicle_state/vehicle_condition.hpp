#pragma once

#include <optional>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/vehicle_status.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/own/hull_alarms.hpp"
#include "firmware/wire/n2k/sensors/sensors.hpp"

namespace earshot::n2k {

/// Between two statuses, at least, unless an alarm is new: a second, less what messages of one second are apart from it.
inline constexpr Duration kVehicleStatusPeriod = Duration::milliseconds(900);

/// Makes vehicle statuses of what several devices say: altitude (128267) and charge (127506), which Sensors reads, leak and ground fault
/// (65293). A part that is not available or too old is not known; an alarm lasts until the device that gave it takes it back (HullAlarms).
class VehicleCondition {
 public:
  /// @param oldest_altitude  what it may be older than the newest part, at most; a charge, which changes slowly: its message's timeout
  explicit VehicleCondition(Duration oldest_altitude) : oldest_altitude_(oldest_altitude) {}

  /// @param heard  of 65293
  /// @param now  its arrival
  /// @return otherwise than kOk: not taken, as read_hull() says.
  [[nodiscard]] Status accept_hull(const HeardFrame& heard, const Directory& directory, Time now);

  /// @param now  never goes back
  /// @return kOk: `status`, dated as its newest part arrived, is to be given. kNotReady: nothing is new, or the last was given less than
  /// kVehicleStatusPeriod ago; an alarm that is new does not wait.
  [[nodiscard]] Status give(const Sensors& sensors, Time now, messages::VehicleStatus& status);

 private:
  /// What was given last.
  struct Given {
    messages::VehicleStatus status;
    Time at;
  };
  Duration oldest_altitude_;
  HullAlarms hull_;
  std::optional<Time> hull_heard_;
  std::optional<Given> given_;
};

}  // namespace earshot::n2k
