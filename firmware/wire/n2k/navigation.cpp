#include "firmware/wire/n2k/navigation.hpp"

#include <optional>

#include "firmware/core/math.hpp"
#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/hydrostatics.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {

namespace {

constexpr double kTrueNorth = 0.0;      ///< DIRECTION_REFERENCE
constexpr double kWaterPressure = 1.0;  ///< PRESSURE_SOURCE
constexpr double kTwoPi = 6.283185307179586;

/// In [0, 2 pi), as the bus wants it.
double positive(Radians angle) {
  const double wrapped = wrap_to_pi(angle).value;
  return wrapped < 0.0 ? wrapped + kTwoPi : wrapped;
}

/// `value`, provided that field `signal` of the same message says `expected`.
Result<double> provided(Result<double> value, std::uint32_t pgn, std::string_view signal, double expected,
                        std::span<const std::uint8_t> bytes) {
  const Result<double> found = read(pgn, signal, bytes);
  if (!found.ok()) return found.status();
  if (found.value() != expected) return Status::kUnsupported;
  return value;
}

Result<double> measured(std::uint32_t pgn, std::span<const std::uint8_t> bytes) {
  switch (pgn) {
    case kHeadingPgn:
      return provided(read(pgn, "Heading", bytes), pgn, "Reference", kTrueNorth, bytes);
    case kSpeedPgn:
      return read(pgn, "SpeedWaterReferenced", bytes);
    default:
      return provided(read(pgn, "Pressure", bytes), pgn, "Source", kWaterPressure, bytes);
  }
}

}  // namespace

Status compose_navigation(const messages::Navigation& navigation, const LocalPlane& plane, std::uint8_t source, NavigationFrames& frames) {
  const Result<Geographic> place = plane.to_geographic(navigation.position);
  if (!place.ok() || !is_finite(navigation.heading.value)) return Status::kOutOfRange;
  const std::array statuses{
      MessageWriter(kHeadingPgn).set("Heading", positive(navigation.heading)).set("Reference", kTrueNorth).frame(source, frames[0]),
      MessageWriter(kSpeedPgn).set("SpeedWaterReferenced", navigation.speed.value).frame(source, frames[1]),
      MessageWriter(kPressurePgn)
          .set("Instance", 0)
          .set("Source", kWaterPressure)
          .set("Pressure", gauge_pressure_pa_at(navigation.depth))
          .frame(source, frames[2]),
      MessageWriter(kPositionPgn)
          .set("Latitude", place.value().latitude_deg)
          .set("Longitude", place.value().longitude_deg)
          .frame(source, frames[3]),
  };
  for (const Status status : statuses) {
    if (status != Status::kOk) return status;
  }
  return Status::kOk;
}

Status NavigationReceiver::accept(const Frame& frame, Time now, messages::Navigation& navigation) {
  const Result<Identifier> identifier = parse_identifier(frame.identifier);
  const Message* message = identifier.ok() ? find_message(identifier.value().pgn) : nullptr;
  if (message == nullptr || message->direction != Direction::kToRuntime) {
    ++counters_.other;
    return Status::kNotReady;
  }
  const Status status = message->pgn == kPositionPgn ? complete(frame, now, navigation) : keep(message->pgn, frame, now);
  if (status == Status::kOk) ++counters_.accepted;
  if (status == Status::kStale) ++counters_.waiting;
  if (status != Status::kOk && status != Status::kStale && status != Status::kNotReady) ++counters_.refused;
  return status;
}

Status NavigationReceiver::keep(std::uint32_t pgn, const Frame& frame, Time now) {
  const Result<double> value = measured(pgn, frame.bytes());
  if (!value.ok()) return value.status() == Status::kNotReady ? Status::kOutOfRange : value.status();
  std::optional<Sample>& sample = pgn == kHeadingPgn ? heading_ : pgn == kSpeedPgn ? speed_ : depth_;
  sample = Sample{pgn == kPressurePgn ? depth_of(value.value()).value : value.value(), now};
  return Status::kNotReady;
}

Status NavigationReceiver::complete(const Frame& frame, Time now, messages::Navigation& navigation) {
  const Result<double> latitude = read(kPositionPgn, "Latitude", frame.bytes());
  const Result<double> longitude = read(kPositionPgn, "Longitude", frame.bytes());
  if (!latitude.ok() || !longitude.ok()) return Status::kOutOfRange;
  const Result<NorthEast> position = plane_.to_local({latitude.value(), longitude.value()});
  if (!position.ok()) return position.status();

  const auto fresh = [now](const std::optional<Sample>& sample, std::uint32_t pgn) {
    return sample.has_value() && lies_within(sample->time, now, find_message(pgn)->timeout);
  };
  if (!fresh(heading_, kHeadingPgn) || !fresh(speed_, kSpeedPgn) || !fresh(depth_, kPressurePgn)) return Status::kStale;
  navigation = {.time = now,
                .position = position.value(),
                .depth = Meters{depth_->value},
                .heading = wrap_to_pi(Radians{heading_->value}),
                .speed = MetersPerSecond{speed_->value}};
  return Status::kOk;
}

}  // namespace earshot::n2k
