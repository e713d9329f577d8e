#include "firmware/wire/n2k/sensors/fields.hpp"

#include <algorithm>
#include <iterator>

#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k::fields {

namespace {

using table::field;
using table::raw_of;

constexpr std::int64_t kTrue = raw_of(table::kDirectionReference, "True");
constexpr std::int64_t kMagnetic = raw_of(table::kDirectionReference, "Magnetic");
/// Ways to a position that is not where the vehicle is: none, by hand, made up.
constexpr std::int64_t kNotMeasured[]{raw_of(table::kGnssMethod, "no GNSS"), raw_of(table::kGnssMethod, "Manual Input"),
                                      raw_of(table::kGnssMethod, "Simulate mode")};
constexpr std::int64_t kWaterPressure = raw_of(table::kPressureSource, "Water");
constexpr std::int64_t kBatteryType = raw_of(table::kDcType, "Battery");
constexpr std::int64_t kSeaTemperature = raw_of(table::kTemperatureSource, "Sea Temperature");

/// The first failure of two; kOk if there is none. What is wrong goes before what is not there.
constexpr Status worse_of(Status a, Status b) {
  if (a == Status::kOk || (a == Status::kNotReady && b != Status::kOk)) return b;
  return a;
}

template <class T>
Result<T> as(const Result<double>& value) {
  if (!value.ok()) return value.status();
  return T{value.value()};
}

template <class T>
std::optional<T> if_any(const Result<double>& value) {
  return value.ok() ? std::optional<T>(T{value.value()}) : std::nullopt;
}

Result<Geographic> place(const Result<double>& latitude, const Result<double>& longitude) {
  const Status status = worse_of(latitude.status(), longitude.status());
  if (status != Status::kOk) return status;
  return Geographic{.latitude_deg = latitude.value(), .longitude_deg = longitude.value()};
}

std::optional<std::uint8_t> instance_in(const Signal& signal, Bytes bytes) {
  const Result<std::int64_t> raw = decode_raw(signal, bytes);
  return raw.ok() ? std::optional(static_cast<std::uint8_t>(raw.value())) : std::nullopt;
}

Result<Sourced> sourced(const Result<double>& value, const Result<std::int64_t>& source, std::int64_t water) {
  if (!source.ok()) return source.status() == Status::kNotReady ? Status::kUnsupported : source.status();
  if (source.value() != water) return Sourced{};
  if (!value.ok()) return value.status();
  return Sourced{.value = value.value(), .is_water = true};
}

}  // namespace

Result<Geographic> position(Bytes bytes) {
  constexpr Signal kLatitude = field(table::kPosition, "Latitude");
  constexpr Signal kLongitude = field(table::kPosition, "Longitude");
  return place(decode(kLatitude, bytes), decode(kLongitude, bytes));
}

Result<Geographic> gnss_position(Bytes bytes) {
  constexpr Signal kMethod = field(table::kGnss, "Method");
  constexpr Signal kLatitude = field(table::kGnss, "Latitude");
  constexpr Signal kLongitude = field(table::kGnss, "Longitude");
  const Result<std::int64_t> method = decode_raw(kMethod, bytes);
  if (!method.ok() && method.status() != Status::kNotReady) return method.status();
  if (method.ok() && std::ranges::find(kNotMeasured, method.value()) != std::end(kNotMeasured)) return Status::kNotReady;
  return place(decode(kLatitude, bytes), decode(kLongitude, bytes));
}

Result<ReferenceStations> reference_stations(Bytes bytes) {
  constexpr Signal kCount = field(table::kGnss, "ReferenceStations");
  const auto& [kType, kId, kAge] = table::kReferenceStationSignals;
  const Result<std::int64_t> count = decode_raw(kCount, bytes);
  if (!count.ok()) return count.status();
  const auto size = static_cast<std::size_t>(count.value()) * table::kReferenceStationBytes;
  if (bytes.size() - table::kGnss.size < size) return Status::kMalformed;
  ReferenceStations stations;
  for (Bytes rest = bytes.subspan(table::kGnss.size, size); !rest.empty(); rest = rest.subspan(table::kReferenceStationBytes)) {
    const Result<std::int64_t> type = decode_raw(kType, rest);
    const Result<std::int64_t> id = decode_raw(kId, rest);
    ReferenceStation station{.type = {}, .id = {}, .age_s = if_any<double>(decode(kAge, rest))};
    if (type.ok()) station.type = static_cast<std::uint8_t>(type.value());
    if (id.ok()) station.id = static_cast<std::uint16_t>(id.value());
    static_cast<void>(stations.push_back(station));  // there is room for as many as a message holds
  }
  return stations;
}

Result<Heading> heading(Bytes bytes) {
  constexpr Signal kHeading = field(table::kHeading, "Heading");
  constexpr Signal kDeviation = field(table::kHeading, "Deviation");
  constexpr Signal kVariation = field(table::kHeading, "Variation");
  constexpr Signal kReference = field(table::kHeading, "Reference");
  const Result<double> value = decode(kHeading, bytes);
  if (!value.ok()) return value.status();
  const Result<std::int64_t> reference = decode_raw(kReference, bytes);
  if (!reference.ok()) return reference.status() == Status::kNotReady ? Status::kUnsupported : reference.status();
  if (reference.value() == kTrue) return Heading{.value = Radians{value.value()}, .is_true = true, .variation = {}};
  if (reference.value() != kMagnetic) return Status::kUnsupported;
  const std::optional<Radians> deviation = if_any<Radians>(decode(kDeviation, bytes));
  return Heading{.value = Radians{value.value()} + deviation.value_or(Radians{}),
                 .is_true = false,
                 .variation = if_any<Radians>(decode(kVariation, bytes))};
}

Result<Radians> variation(Bytes bytes) {
  constexpr Signal kVariation = field(table::kVariation, "Variation");
  return as<Radians>(decode(kVariation, bytes));
}

Result<RadiansPerSecond> rate_of_turn(Bytes bytes) {
  constexpr Signal kRate = field(table::kRateOfTurn, "Rate");
  return as<RadiansPerSecond>(decode(kRate, bytes));
}

Result<Attitude> attitude(Bytes bytes) {
  constexpr Signal kPitch = field(table::kAttitude, "Pitch");
  constexpr Signal kRoll = field(table::kAttitude, "Roll");
  const Result<double> pitch = decode(kPitch, bytes);
  const Result<double> roll = decode(kRoll, bytes);
  const Status status = worse_of(pitch.status(), roll.status());
  if (status != Status::kOk) return status;
  return Attitude{.pitch = Radians{pitch.value()}, .roll = Radians{roll.value()}};
}

Result<MetersPerSecond> speed(Bytes bytes) {
  constexpr Signal kSpeed = field(table::kSpeed, "SpeedWaterReferenced");
  return as<MetersPerSecond>(decode(kSpeed, bytes));
}

Result<OverGround> over_ground(Bytes bytes) {
  constexpr Signal kReference = field(table::kCourse, "COGReference");
  constexpr Signal kCourse = field(table::kCourse, "COG");
  constexpr Signal kSpeed = field(table::kCourse, "SOG");
  const Result<double> course = decode(kCourse, bytes);
  const Result<double> speed = decode(kSpeed, bytes);
  const Status status = worse_of(course.status(), speed.status());
  if (status != Status::kOk) return status;
  const Result<std::int64_t> reference = decode_raw(kReference, bytes);
  if (!reference.ok() || reference.value() != kTrue) return Status::kUnsupported;
  return OverGround{.course = Radians{course.value()}, .speed = MetersPerSecond{speed.value()}};
}

Result<Meters> altitude(Bytes bytes) {
  constexpr Signal kDepth = field(table::kWaterDepth, "Depth");
  return as<Meters>(decode(kDepth, bytes));
}

Result<Radians> rudder(Bytes bytes) {
  constexpr Signal kPosition = field(table::kRudder, "Position");
  return as<Radians>(decode(kPosition, bytes));
}

Result<Sourced> pressure(Bytes bytes) {
  constexpr Signal kPressure = field(table::kPressure, "Pressure");
  constexpr Signal kSource = field(table::kPressure, "Source");
  return sourced(decode(kPressure, bytes), decode_raw(kSource, bytes), kWaterPressure);
}

Result<Sourced> temperature(Bytes bytes) {
  constexpr Signal kTemperature = field(table::kTemperature, "ActualTemperature");
  constexpr Signal kSource = field(table::kTemperature, "Source");
  return sourced(decode(kTemperature, bytes), decode_raw(kSource, bytes), kSeaTemperature);
}

Result<Battery> battery(Bytes bytes) {
  constexpr Signal kVoltage = field(table::kBattery, "Voltage");
  constexpr Signal kCurrent = field(table::kBattery, "Current");
  constexpr Signal kTemperature = field(table::kBattery, "Temperature");
  const Result<double> voltage = decode(kVoltage, bytes);
  const Result<double> current = decode(kCurrent, bytes);
  const Result<double> temperature = decode(kTemperature, bytes);
  if (!voltage.ok() && !current.ok() && !temperature.ok())
    return worse_of(worse_of(voltage.status(), current.status()), temperature.status());
  return Battery{.voltage_v = if_any<double>(voltage), .current_a = if_any<double>(current), .temperature_k = if_any<double>(temperature)};
}

Result<std::optional<double>> charge(Bytes bytes) {
  constexpr Signal kType = field(table::kCharge, "DCType");
  constexpr Signal kCharge = field(table::kCharge, "StateOfCharge");
  const Result<std::int64_t> type = decode_raw(kType, bytes);
  if (!type.ok()) return type.status() == Status::kNotReady ? Status::kUnsupported : type.status();
  if (type.value() != kBatteryType) return std::optional<double>{};
  const Result<double> percent = decode(kCharge, bytes);
  if (!percent.ok()) return percent.status();
  if (percent.value() > 100.0) return Status::kOutOfRange;
  return std::optional(percent.value());
}

std::optional<std::uint8_t> rudder_instance(Bytes bytes) {
  constexpr Signal kInstance = field(table::kRudder, "Instance");
  return instance_in(kInstance, bytes);
}

std::optional<std::uint8_t> pressure_instance(Bytes bytes) {
  constexpr Signal kInstance = field(table::kPressure, "Instance");
  return instance_in(kInstance, bytes);
}

std::optional<std::uint8_t> temperature_instance(Bytes bytes) {
  constexpr Signal kInstance = field(table::kTemperature, "Instance");
  return instance_in(kInstance, bytes);
}

std::optional<std::uint8_t> battery_instance(Bytes bytes) {
  constexpr Signal kInstance = field(table::kBattery, "Instance");
  return instance_in(kInstance, bytes);
}

std::optional<std::uint8_t> charge_instance(Bytes bytes) {
  constexpr Signal kInstance = field(table::kCharge, "Instance");
  return instance_in(kInstance, bytes);
}

}  // namespace earshot::n2k::fields
