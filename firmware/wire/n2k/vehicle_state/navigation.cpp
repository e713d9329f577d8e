#include "firmware/wire/n2k/vehicle_state/navigation.hpp"

#include <optional>

#include "firmware/core/compass.hpp"
#include "firmware/core/math.hpp"
#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/hydrostatics.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {

namespace {

constexpr double kTrueNorth = 0.0;      ///< DIRECTION_REFERENCE
constexpr double kWaterPressure = 1.0;  ///< PRESSURE_SOURCE

}  // namespace

Status compose_navigation(const messages::Navigation& navigation, const LocalPlane& plane, std::uint8_t source, NavigationFrames& frames) {
  const Result<Geographic> place = plane.to_geographic(navigation.position);
  if (!place.ok() || !is_finite(navigation.heading.value)) return Status::kOutOfRange;
  MessageWriter speed(table::kSpeed);
  if (navigation.speed.value == navigation.speed.value) speed.set("SpeedWaterReferenced", navigation.speed.value);  // not NaN
  const std::array statuses{
      MessageWriter(table::kHeading)
          .set("Heading", wrap_to_two_pi(navigation.heading).value)
          .set("Reference", kTrueNorth)
          .frame(source, frames[0]),
      speed.frame(source, frames[1]),
      MessageWriter(table::kPressure)
          .set("Instance", 0)
          .set("Source", kWaterPressure)
          .set("Pressure", gauge_pressure_pa_at(navigation.depth))
          .frame(source, frames[2]),
      MessageWriter(table::kPosition)
          .set("Latitude", place.value().latitude_deg)
          .set("Longitude", place.value().longitude_deg)
          .frame(source, frames[3]),
  };
  for (const Status status : statuses) {
    if (status != Status::kOk) return status;
  }
  return Status::kOk;
}

Status NavigationReceiver::accept(const HeardFrame& heard, Time now, Fix& fix) {
  const SensorCounters before = sensors_.counters();
  Measured measured{};
  Status status = sensors_.accept(heard, now, measured);
  if (sensors_.counters().of_no_interest != before.of_no_interest) ++counters_.other;
  if (status == Status::kMalformed || status == Status::kOutOfRange) ++counters_.malformed;
  if (status == Status::kOk) status = measured == Measured::kPosition ? complete(fix) : Status::kNotReady;
  if (status == Status::kOk) ++counters_.accepted;
  if (status == Status::kStale) ++counters_.waiting;
  if (status != Status::kOk && status != Status::kStale && status != Status::kNotReady) ++counters_.refused;
  return status;
}

Status NavigationReceiver::accept(const HeardFrame& heard, Time now, messages::Navigation& navigation) {
  Fix fix;
  const Status status = accept(heard, now, fix);
  if (status != Status::kOk) return status;
  navigation = {.time = fix.time,
                .position = fix.position,
                .depth = fix.depth,
                .heading = fix.heading,
                .speed = fix.speed.value_or(messages::kUnknownSpeed)};
  return Status::kOk;
}

Status NavigationReceiver::complete(Fix& fix) const {
  const Readings& readings = sensors_.readings();
  const Result<NorthEast> position = plane_.to_local(readings.position->value);
  if (!position.ok()) return position.status();
  const Time time = readings.position->time;
  if (!is_fresh(readings.heading, time, oldest_part_) || !is_fresh(readings.depth, time, oldest_part_)) return Status::kStale;
  fix = {.time = time, .position = position.value(), .depth = readings.depth->value, .heading = readings.heading->value, .speed = {}};
  if (is_fresh(readings.speed, time, oldest_part_)) fix.speed = readings.speed->value;
  return Status::kOk;
}

}  // namespace earshot::n2k
