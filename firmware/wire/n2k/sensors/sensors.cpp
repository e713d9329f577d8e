#include "firmware/wire/n2k/sensors/sensors.hpp"

#include "firmware/core/math.hpp"
#include "firmware/wire/n2k/hydrostatics.hpp"
#include "firmware/wire/n2k/sensors/fields.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {

Sensors::Sensors(const SensorSettings& settings) : settings_(settings) {
  for (std::size_t i = 0; i < kMeasured; ++i) gates_[i] = SourceGate(settings.sources[i]);
}

Status Sensors::accept(const Frame& frame, Time now, Measured& measured) {
  const Result<Identifier> parsed = parse_identifier(frame.identifier);
  if (!parsed.ok()) {
    ++counters_.of_no_interest;
    return Status::kNotReady;
  }
  const Identifier& identifier = parsed.value();
  Status status = Status::kNotReady;
  if (identifier.pgn == kAddressClaimPgn) {
    directory_.accept(identifier.source, frame);
  } else if (identifier.pgn == kGnssPgn) {
    measured = Measured::kPosition;
    status = take_gnss(identifier, frame, now);
  } else {
    status = take({.identifier = identifier, .bytes = frame.bytes(), .time = now}, measured);
  }
  if (status == Status::kOk) ++counters_.taken;
  if (status != Status::kOk && status != Status::kNotReady) ++counters_.refused;
  return status;
}

Status Sensors::take(const Arrival& arrival, Measured& measured) {
  const auto& [identifier, bytes, time] = arrival;
  switch (identifier.pgn) {
    case kPositionPgn:
      measured = Measured::kPosition;
      return admits(measured, arrival, table::kPosition) ? keep(readings_.position, fields::position(bytes), time) : Status::kNotReady;
    case kHeadingPgn:
      measured = Measured::kHeading;
      return admits(measured, arrival, table::kHeading) ? keep(readings_.heading, true_heading(bytes, time), time) : Status::kNotReady;
    case kVariationPgn:
      measured = Measured::kVariation;
      return admits(measured, arrival, table::kVariation) ? keep(readings_.variation, fields::variation(bytes), time) : Status::kNotReady;
    case kRateOfTurnPgn:
      measured = Measured::kRateOfTurn;
      return admits(measured, arrival, table::kRateOfTurn) ? keep(readings_.rate_of_turn, fields::rate_of_turn(bytes), time)
                                                           : Status::kNotReady;
    case kAttitudePgn:
      measured = Measured::kAttitude;
      return admits(measured, arrival, table::kAttitude) ? keep(readings_.attitude, fields::attitude(bytes), time) : Status::kNotReady;
    case kSpeedPgn:
      measured = Measured::kSpeed;
      return admits(measured, arrival, table::kSpeed) ? keep(readings_.speed, fields::speed(bytes), time) : Status::kNotReady;
    case kCoursePgn:
      measured = Measured::kOverGround;
      return admits(measured, arrival, table::kCourse) ? keep(readings_.over_ground, fields::over_ground(bytes), time) : Status::kNotReady;
    case kWaterDepthPgn:
      measured = Measured::kAltitude;
      return admits(measured, arrival, table::kWaterDepth) ? keep(readings_.altitude, fields::altitude(bytes), time) : Status::kNotReady;
    case kRudderPgn:
      measured = Measured::kRudder;
      return admits(measured, arrival, table::kRudder, fields::rudder_instance(bytes)) ? keep(readings_.rudder, fields::rudder(bytes), time)
                                                                                       : Status::kNotReady;
    case kPressurePgn:
      measured = Measured::kPressure;
      return take_pressure(arrival);
    case kTemperaturePgn:
      measured = Measured::kTemperature;
      return take_temperature(arrival);
    case kBatteryPgn:
      measured = Measured::kBattery;
      return take_battery(arrival);
    default:
      ++counters_.of_no_interest;
      return Status::kNotReady;
  }
}

bool Sensors::admits(Measured measured, const Arrival& arrival, const Message& message, std::optional<std::uint8_t> instance) {
  const Origin origin{.pgn = arrival.identifier.pgn, .address = arrival.identifier.source, .instance = instance};
  if (gates_[static_cast<std::size_t>(measured)].admits(origin, directory_, arrival.time, message.timeout)) return true;
  ++counters_.other_device;
  return false;
}

/// A device that has no value any more takes its last one back; one that sends nonsense does not.
template <class T>
Status Sensors::keep(std::optional<Reading<T>>& reading, Result<T> value, Time time) {
  if (value.ok()) {
    reading = Reading<T>{.value = value.value(), .time = time};
    return Status::kOk;
  }
  if (value.status() != Status::kNotReady) return value.status();
  reading.reset();
  ++counters_.unavailable;
  return Status::kNotReady;
}

Result<Radians> Sensors::true_heading(Bytes bytes, Time now) {
  const Result<fields::Heading> said = fields::heading(bytes);
  if (!said.ok()) return said.status();
  const fields::Heading& heading = said.value();
  if (heading.is_true) return wrap_to_pi(heading.value);
  if (heading.variation) return wrap_to_pi(heading.value + *heading.variation);
  if (!is_fresh(readings_.variation, now, table::kVariation.timeout)) {
    ++counters_.no_variation;
    return Status::kUnsupported;
  }
  return wrap_to_pi(heading.value + readings_.variation->value);
}

Status Sensors::take_gnss(const Identifier& identifier, const Frame& frame, Time now) {
  Assembled message;
  const Status status = assembly_.accept(identifier, frame, now, message);
  if (status != Status::kOk) return status == Status::kNotReady ? status : Status::kMalformed;
  const Arrival arrival{.identifier = identifier, .bytes = message.bytes, .time = message.began};
  if (!admits(Measured::kPosition, arrival, table::kGnss)) return Status::kNotReady;
  return keep(readings_.position, fields::gnss_position(message.bytes), message.began);
}

Status Sensors::take_pressure(const Arrival& arrival) {
  const Result<fields::Sourced> said = fields::pressure(arrival.bytes);
  if (!said.ok() && said.status() != Status::kNotReady) return said.status();
  if (said.ok() && !said.value().is_water) {
    ++counters_.of_no_interest;
    return Status::kNotReady;
  }
  if (!admits(Measured::kPressure, arrival, table::kPressure, fields::pressure_instance(arrival.bytes))) return Status::kNotReady;
  const Status kept =
      keep(readings_.pressure_pa, said.ok() ? Result<double>(said.value().value) : Result<double>(said.status()), arrival.time);
  readings_.depth.reset();
  if (kept != Status::kOk) return kept;
  if (settings_.pressure_kind == PressureKind::kAbsolute && !settings_.surface_pa) {
    ++counters_.no_surface;
    return Status::kUnsupported;
  }
  const double over_surface_pa = readings_.pressure_pa->value - settings_.surface_pa.value_or(0.0);
  readings_.depth = Reading<Meters>{.value = depth_of(over_surface_pa), .time = arrival.time};
  return Status::kOk;
}

Status Sensors::zero_at_surface() {
  if (!readings_.pressure_pa) return Status::kNotReady;
  const double pressure_pa = readings_.pressure_pa->value;
  const bool gauge = settings_.pressure_kind == PressureKind::kGauge;
  const double lowest_pa = gauge ? -20'000.0 : 80'000.0;
  const double highest_pa = gauge ? 20'000.0 : 110'000.0;
  if (!(pressure_pa >= lowest_pa && pressure_pa <= highest_pa)) return Status::kOutOfRange;
  settings_.surface_pa = pressure_pa;
  readings_.depth = Reading<Meters>{.value = Meters{0.0}, .time = readings_.pressure_pa->time};
  return Status::kOk;
}

Status Sensors::take_temperature(const Arrival& arrival) {
  const Result<fields::Sourced> said = fields::temperature(arrival.bytes);
  if (said.ok() && !said.value().is_water) {
    ++counters_.of_no_interest;
    return Status::kNotReady;
  }
  if (!said.ok() && said.status() != Status::kNotReady) return said.status();
  if (!admits(Measured::kTemperature, arrival, table::kTemperature, fields::temperature_instance(arrival.bytes))) return Status::kNotReady;
  return keep(readings_.water_temperature_k, said.ok() ? Result<double>(said.value().value) : Result<double>(said.status()), arrival.time);
}

Status Sensors::take_battery(const Arrival& arrival) {
  if (!admits(Measured::kBattery, arrival, table::kBattery, fields::battery_instance(arrival.bytes))) return Status::kNotReady;
  return keep(readings_.battery, fields::battery(arrival.bytes), arrival.time);
}

}  // namespace earshot::n2k
