#include "firmware/wire/n2k/vehicle_state/vehicle_condition.hpp"

#include <algorithm>

#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {
namespace {

template <class T>
std::optional<T> if_fresh(const std::optional<Reading<T>>& reading, Time now, Duration age) {
  return is_fresh(reading, now, age) ? std::optional(reading->value) : std::nullopt;
}

bool has_new_alarm(const messages::VehicleStatus& status, const messages::VehicleStatus& given) {
  return (status.has_leak && !given.has_leak) || (status.has_ground_fault && !given.has_ground_fault);
}

}  // namespace

Status VehicleCondition::accept_hull(const HeardFrame& heard, const Directory& directory, Time now) {
  if (!heard.identifier.ok()) return heard.identifier.status();
  const Result<Hull> hull = read_hull(heard.frame.bytes());
  if (!hull.ok()) return hull.status();
  hull_.take(hull.value(), heard.identifier.value().source, directory);
  hull_heard_ = now;
  return Status::kOk;
}

Status VehicleCondition::give(const Sensors& sensors, Time now, messages::VehicleStatus& status) {
  // An empty optional is less than any other.
  const std::optional<Time> newest = std::max({sensors.heard(Measured::kAltitude), sensors.heard(Measured::kCharge), hull_heard_});
  if (!newest) return Status::kNotReady;
  const Readings& readings = sensors.readings();
  status = {.time = *newest,
            .altitude = if_fresh(readings.altitude, *newest, oldest_altitude_).value_or(Meters{messages::VehicleStatus::kUnknown}),
            .battery_percent =
                if_fresh(readings.charge_percent, *newest, table::timeout_of(table::kCharge)).value_or(messages::VehicleStatus::kUnknown),
            .has_leak = hull_.has_leak(),
            .has_ground_fault = hull_.has_ground_fault()};
  const bool is_due = !given_ || (*newest > given_->status.time && now - given_->at >= kVehicleStatusPeriod);
  if (!is_due && !has_new_alarm(status, given_->status)) return Status::kNotReady;
  given_ = Given{.status = status, .at = now};
  return Status::kOk;
}

}  // namespace earshot::n2k
