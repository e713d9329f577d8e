#include "firmware/wire/n2k/setpoint.hpp"

#include <utility>

#include "firmware/core/compass.hpp"
#include "firmware/core/math.hpp"
#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::n2k {

namespace {

constexpr double kTrueNorth = 0.0;       ///< DIRECTION_REFERENCE
constexpr double kHeadingControl = 4.0;  ///< STEERING_MODE
constexpr double kManufacturer = table::kManufacturer;
constexpr double kMarineIndustry = table::kMarineIndustry;
constexpr double kYes = 1.0;        ///< YES_NO
constexpr unsigned kSequences = 8;  ///< of a fast packet: 3 bits

constexpr FieldName kSpeed = kBusName<&messages::Setpoint::speed>;
constexpr FieldName kDepth = kBusName<&messages::Setpoint::depth>;
constexpr FieldName kReleaseWeight = kBusName<&messages::Setpoint::release_weight>;

}  // namespace

Status compose_setpoint(const messages::Setpoint& setpoint, std::uint8_t source, std::uint8_t sequence, SetpointFrames& frames) {
  if (!is_finite(setpoint.heading.value)) return Status::kOutOfRange;
  Frame speed_depth;
  Status status = MessageWriter(table::kSpeedDepth)
                      .set("ManufacturerCode", kManufacturer)
                      .set("IndustryGroup", kMarineIndustry)
                      .set(kSpeed, setpoint.speed.value)
                      .set(kDepth, setpoint.depth.value)
                      .set("HeadingSequence", sequence % kSequences)
                      .set_raw(kReleaseWeight, setpoint.release_weight ? 1 : 0)
                      .frame(source, speed_depth);
  if (status != Status::kOk) return status;

  MessageWriter control(table::kHeadingControl);
  control.set("SteeringMode", kHeadingControl)
      .set("HeadingReference", kTrueNorth)
      .set("HeadingToSteer", wrap_to_two_pi(setpoint.heading).value);
  if (control.status() != Status::kOk) return control.status();
  FastPacketFrames packet;
  status = compose_fast_packet(control.identifier(source), sequence, control.bytes(), packet);
  if (status != Status::kOk) return status;

  frames.clear();
  status = frames.push_back(speed_depth);
  for (const Frame& frame : packet) {
    if (status == Status::kOk) status = frames.push_back(frame);
  }
  return status;
}

Status SetpointReceiver::accept(const HeardFrame& heard, messages::Setpoint& setpoint) {
  if (!heard.identifier.ok()) return heard.identifier.status();
  const Identifier& identifier = heard.identifier.value();
  const Frame& frame = heard.frame;
  if (identifier.pgn == kSpeedDepthPgn) {
    const Result<double> maker = read(kSpeedDepthPgn, "ManufacturerCode", frame.bytes());
    const Result<double> industry = read(kSpeedDepthPgn, "IndustryGroup", frame.bytes());
    if (!maker.ok() || maker.value() != kManufacturer || !industry.ok() || industry.value() != kMarineIndustry) return Status::kNotReady;
    const Result<double> speed = read(kSpeedDepthPgn, kSpeed, frame.bytes());
    const Result<double> depth = read(kSpeedDepthPgn, kDepth, frame.bytes());
    const Result<double> sequence = read(kSpeedDepthPgn, "HeadingSequence", frame.bytes());
    const Result<double> release = read(kSpeedDepthPgn, kReleaseWeight, frame.bytes());
    speed_depth_.reset();
    if (!speed.ok() || !depth.ok() || !sequence.ok() || !(sequence.value() < kSequences)) return Status::kOutOfRange;
    speed_depth_ = SpeedDepth{MetersPerSecond{speed.value()}, Meters{depth.value()}, static_cast<unsigned>(sequence.value()),
                              identifier.source, release.ok() && release.value() == kYes};
    return Status::kNotReady;
  }
  if (identifier.pgn != kHeadingControlPgn) return Status::kNotReady;
  std::span<const std::uint8_t> bytes;
  const Status status = assembly_.accept(identifier, frame, bytes);
  if (status != Status::kOk) return status;
  const Result<double> heading = read(kHeadingControlPgn, "HeadingToSteer", bytes);
  const Result<double> reference = read(kHeadingControlPgn, "HeadingReference", bytes);
  if (!heading.ok() || !reference.ok()) return Status::kOutOfRange;
  if (reference.value() != kTrueNorth) return Status::kUnsupported;
  if (speed_depth_ && speed_depth_->source != identifier.source) return Status::kNotReady;  // another device's heading
  // Whatever is waiting is used up: of two halves that are not of one set-point, the other half of each was lost.
  const std::optional<SpeedDepth> speed_depth = std::exchange(speed_depth_, std::nullopt);
  if (!speed_depth || speed_depth->sequence != frame.data[0] / (256U / kSequences)) return Status::kNotReady;
  last_sequence_ = static_cast<std::uint8_t>(speed_depth->sequence);
  setpoint = {.heading = wrap_to_pi(Radians{heading.value()}),
              .speed = speed_depth->speed,
              .depth = speed_depth->depth,
              .waypoint = {},
              .release_weight = speed_depth->release_weight};
  return Status::kOk;
}

}  // namespace earshot::n2k
