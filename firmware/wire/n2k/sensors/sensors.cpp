#include "firmware/wire/n2k/sensors/sensors.hpp"

#include <cstdint>
#include <span>

#include "firmware/core/math.hpp"
#include "firmware/wire/n2k/hydrostatics.hpp"
#include "firmware/wire/n2k/sensors/fields.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {
namespace {

/// A function of fields.hpp that is called by its name: the core calls nothing through a pointer.
template <auto kRead>
constexpr auto by = [](std::span<const std::uint8_t> bytes) { return kRead(bytes); };

/// What was read already.
auto value_of(const Result<fields::Sourced>& field) {
  return [&field](std::span<const std::uint8_t> /*bytes*/) {
    return field.ok() ? Result<double>(field.value().value) : Result<double>(field.status());
  };
}

}  // namespace

Sensors::Sensors(const SensorSettings& settings) : pressure_kind_(settings.pressure_kind), surface_pa_(settings.surface_pa) {
  for (std::size_t i = 0; i < kMeasured; ++i) gates_[i] = SourceGate(settings.sources[i]);
}

Status Sensors::accept(const HeardFrame& heard, Time now, Measured& measured) {
  if (!heard.identifier.ok()) {
    ++counters_.of_no_interest;
    return Status::kNotReady;
  }
  const Identifier& identifier = heard.identifier.value();
  const Frame& frame = heard.frame;
  Status status = Status::kNotReady;
  if (identifier.pgn == kAddressClaimPgn) {
    directory_.accept(identifier.source, frame);
  } else if (identifier.pgn == kGnssPgn || identifier.pgn == kChargePgn) {
    status = take_packet(identifier, frame, now, measured);
  } else {
    status = take({.identifier = identifier, .bytes = frame.bytes(), .time = now}, measured);
  }
  if (status == Status::kOk) ++counters_.taken;
  if (status != Status::kOk && status != Status::kNotReady) ++counters_.refused;
  return status;
}

Status Sensors::take(const Arrival& arrival, Measured& measured) {
  switch (arrival.identifier.pgn) {
    case kPositionPgn:
      measured = Measured::kPosition;
      return keep_admitted(measured, arrival, table::handover_of(table::kPosition), readings_.position, by<fields::position>);
    case kHeadingPgn:
      measured = Measured::kHeading;
      return keep_admitted(measured, arrival, table::handover_of(table::kHeading), readings_.heading,
                           [&](Bytes bytes) { return true_heading(bytes, arrival.time); });
    case kVariationPgn:
      measured = Measured::kVariation;
      return keep_admitted(measured, arrival, table::handover_of(table::kVariation), readings_.variation, by<fields::variation>);
    case kRateOfTurnPgn:
      measured = Measured::kRateOfTurn;
      return keep_admitted(measured, arrival, table::handover_of(table::kRateOfTurn), readings_.rate_of_turn, by<fields::rate_of_turn>);
    case kAttitudePgn:
      measured = Measured::kAttitude;
      return keep_admitted(measured, arrival, table::handover_of(table::kAttitude), readings_.attitude, by<fields::attitude>);
    case kSpeedPgn:
      measured = Measured::kSpeed;
      return keep_admitted(measured, arrival, table::handover_of(table::kSpeed), readings_.speed, by<fields::speed>);
    case kCoursePgn:
      measured = Measured::kOverGround;
      return keep_admitted(measured, arrival, table::handover_of(table::kCourse), readings_.over_ground, by<fields::over_ground>);
    case kWaterDepthPgn:
      measured = Measured::kAltitude;
      return keep_admitted(measured, arrival, table::handover_of(table::kWaterDepth), readings_.altitude, by<fields::altitude>);
    case kRudderPgn:
      measured = Measured::kRudder;
      return keep_admitted(measured, arrival, table::handover_of(table::kRudder), readings_.rudder, by<fields::rudder>,
                           fields::rudder_instance(arrival.bytes));
    case kPressurePgn:
      measured = Measured::kPressure;
      return take_pressure(arrival);
    case kTemperaturePgn:
      measured = Measured::kTemperature;
      return take_temperature(arrival);
    case kBatteryPgn:
      measured = Measured::kBattery;
      return keep_admitted(measured, arrival, table::handover_of(table::kBattery), readings_.battery, by<fields::battery>,
                           fields::battery_instance(arrival.bytes));
    default:
      ++counters_.of_no_interest;
      return Status::kNotReady;
  }
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

template <class T, class Read>
Status Sensors::keep_admitted(Measured measured, const Arrival& arrival, Duration handover, std::optional<Reading<T>>& reading,
                              const Read& read, std::optional<std::uint8_t> instance) {
  SourceGate& gate = gates_[static_cast<std::size_t>(measured)];
  const Origin origin{.pgn = arrival.identifier.pgn, .address = arrival.identifier.source, .instance = instance};
  const SourceStatus source_status = gate.status_of(origin, directory_, arrival.time, handover);
  if (source_status == SourceStatus::kNotChosen) ++counters_.not_chosen[static_cast<std::size_t>(measured)];
  if (source_status == SourceStatus::kNotChosen || source_status == SourceStatus::kHeldByAnother) {
    ++counters_.other_device;
    return Status::kNotReady;
  }
  const Result<T> value = read(arrival.bytes);
  if (value.ok() || value.status() == Status::kNotReady) heard_[static_cast<std::size_t>(measured)] = arrival.time;
  if (value.ok()) gate.hold(origin, directory_, arrival.time);
  if (source_status == SourceStatus::kHolds || value.ok()) return keep<T>(reading, value, arrival.time);
  if (value.status() == Status::kNotReady) ++counters_.unavailable;
  return value.status();
}

Result<Radians> Sensors::true_heading(Bytes bytes, Time now) {
  const Result<fields::Heading> field = fields::heading(bytes);
  if (!field.ok()) return field.status();
  const fields::Heading& heading = field.value();
  if (heading.is_true) return wrap_to_pi(heading.value);
  if (heading.variation) return wrap_to_pi(heading.value + *heading.variation);
  if (!is_fresh(readings_.variation, now, table::timeout_of(table::kVariation))) {
    ++counters_.no_variation;
    return Status::kUnsupported;
  }
  return wrap_to_pi(heading.value + readings_.variation->value);
}

Status Sensors::take_packet(const Identifier& identifier, const Frame& frame, Time now, Measured& measured) {
  measured = identifier.pgn == kGnssPgn ? Measured::kPosition : Measured::kCharge;
  Assembled message;
  const Status status = assembly_.accept(identifier, frame, now, message);
  if (status != Status::kOk) return status == Status::kNotReady ? status : Status::kMalformed;
  const Arrival arrival{.identifier = identifier, .bytes = message.bytes, .time = message.began};
  if (measured == Measured::kCharge) return take_charge(arrival);
  return keep_admitted(Measured::kPosition, arrival, table::handover_of(table::kGnss), readings_.position, by<fields::gnss_position>);
}

Status Sensors::take_pressure(const Arrival& arrival) {
  const Result<fields::Sourced> field = fields::pressure(arrival.bytes);
  if (!field.ok() && field.status() != Status::kNotReady) return field.status();
  if (field.ok() && !field.value().is_water) {
    ++counters_.of_no_interest;
    return Status::kNotReady;
  }
  const Status kept = keep_admitted(Measured::kPressure, arrival, table::handover_of(table::kPressure), readings_.pressure_pa,
                                    value_of(field), fields::pressure_instance(arrival.bytes));
  if (!readings_.pressure_pa) readings_.depth.reset();
  if (kept != Status::kOk) return kept;
  if (pressure_kind_ == PressureKind::kAbsolute && !surface_pa_) {
    ++counters_.no_surface;
    return Status::kUnsupported;
  }
  const double over_surface_pa = readings_.pressure_pa->value - surface_pa_.value_or(0.0);
  readings_.depth = Reading<Meters>{.value = depth_of(over_surface_pa), .time = arrival.time};
  return Status::kOk;
}

Status Sensors::zero_at_surface() {
  if (!readings_.pressure_pa) return Status::kNotReady;
  const double pressure_pa = readings_.pressure_pa->value;
  const bool gauge = pressure_kind_ == PressureKind::kGauge;
  const double lowest_pa = gauge ? -20'000.0 : 80'000.0;
  const double highest_pa = gauge ? 20'000.0 : 110'000.0;
  if (!(pressure_pa >= lowest_pa && pressure_pa <= highest_pa)) return Status::kOutOfRange;
  surface_pa_ = pressure_pa;
  readings_.depth = Reading<Meters>{.value = Meters{0.0}, .time = readings_.pressure_pa->time};
  return Status::kOk;
}

Status Sensors::take_temperature(const Arrival& arrival) {
  const Result<fields::Sourced> field = fields::temperature(arrival.bytes);
  if (field.ok() && !field.value().is_water) {
    ++counters_.of_no_interest;
    return Status::kNotReady;
  }
  if (!field.ok() && field.status() != Status::kNotReady) return field.status();
  return keep_admitted(Measured::kTemperature, arrival, table::handover_of(table::kTemperature), readings_.water_temperature_k,
                       value_of(field), fields::temperature_instance(arrival.bytes));
}

Status Sensors::take_charge(const Arrival& arrival) {
  const Result<std::optional<double>> field = fields::charge(arrival.bytes);
  if (field.ok() && !field.value()) {
    ++counters_.of_no_interest;
    return Status::kNotReady;
  }
  const auto read = [&field](Bytes /*bytes*/) { return field.ok() ? Result<double>(*field.value()) : Result<double>(field.status()); };
  return keep_admitted(Measured::kCharge, arrival, table::handover_of(table::kCharge), readings_.charge_percent, read,
                       fields::charge_instance(arrival.bytes));
}

}  // namespace earshot::n2k
