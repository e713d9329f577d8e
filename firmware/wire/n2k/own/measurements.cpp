#include "firmware/wire/n2k/own/measurements.hpp"

#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {

Status compose_snr(const HeardSnr& heard, std::uint8_t source, Frame& frame) {
  MessageWriter writer = begin_own(table::kSnr);
  writer.set("SNR", heard.snr.value).set_raw("TooFaint", heard.too_faint ? 1 : 0);
  if (heard.band_level) writer.set("BandLevel", heard.band_level->value);
  return writer.frame(source, frame);
}

Result<HeardSnr> read_snr(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kSnr, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kSnr, bytes);
  HeardSnr heard{.snr = Decibels{reader.value("SNR")}, .too_faint = reader.yes("TooFaint"), .band_level = {}};
  if (reader.status() != Status::kOk) return reader.status();
  constexpr Signal kBandLevel = table::field(table::kSnr, "BandLevel");
  if (const Result<double> level = decode(kBandLevel, bytes); level.ok()) heard.band_level = Decibels{level.value()};
  return heard;
}

messages::SnrMeasurement measurement_of(const HeardSnr& heard, Time arrival) {
  return {.time = arrival, .snr = heard.snr, .too_faint = heard.too_faint};
}

Status compose_altitude(Meters altitude, std::uint8_t source, Frame& frame) {
  return begin_own(table::kAltitude).set("Altitude", altitude.value).frame(source, frame);
}

Result<Meters> read_altitude(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kAltitude, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kAltitude, bytes);
  const Meters altitude{reader.value("Altitude")};
  if (reader.status() != Status::kOk) return reader.status();
  return altitude;
}

}  // namespace earshot::n2k
