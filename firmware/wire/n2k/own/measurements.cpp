#include "firmware/wire/n2k/own/measurements.hpp"

#include "firmware/wire/n2k/own/fields.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {
namespace {

using messages::SnrMeasurement;

constexpr FieldName kAltitude = kBusName<&messages::VehicleStatus::altitude>;

}  // namespace

Status compose_snr(const HeardSnr& heard, std::uint8_t source, Frame& frame) {
  MessageWriter writer = begin_own(table::kSnr);
  write_fields(measurement_of(heard, {}), {}, writer);
  if (heard.band_level) writer.set("BandLevel", heard.band_level->value);
  return writer.frame(source, frame);
}

Result<HeardSnr> read_snr(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kSnr, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kSnr, bytes);
  HeardSnr heard{.snr = Decibels{reader.value(kBusName<&SnrMeasurement::snr>)},
                 .too_faint = reader.yes(kBusName<&SnrMeasurement::too_faint>),
                 .band_level = {}};
  if (reader.status() != Status::kOk) return reader.status();
  constexpr Signal kBandLevel = table::field(table::kSnr, "BandLevel");
  if (const Result<double> level = decode(kBandLevel, bytes); level.ok()) heard.band_level = Decibels{level.value()};
  return heard;
}

messages::SnrMeasurement measurement_of(const HeardSnr& heard, Time arrival) {
  return {.time = arrival, .snr = heard.snr, .too_faint = heard.too_faint};
}

Status compose_altitude(Meters altitude, std::uint8_t source, Frame& frame) {
  return begin_own(table::kAltitude).set(kAltitude, altitude.value).frame(source, frame);
}

Result<Meters> read_altitude(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kAltitude, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kAltitude, bytes);
  const Meters altitude{reader.value(kAltitude)};
  if (reader.status() != Status::kOk) return reader.status();
  return altitude;
}

}  // namespace earshot::n2k
