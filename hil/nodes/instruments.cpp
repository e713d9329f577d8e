#include "hil/nodes/instruments.hpp"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "firmware/core/compass.hpp"
#include "firmware/core/math.hpp"
#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/hydrostatics.hpp"

namespace earshot::hil {
namespace {

namespace table = n2k::table;
using n2k::MessageWriter;

constexpr Duration kTenth = Duration::milliseconds(100);
constexpr Duration kQuarter = Duration::milliseconds(250);
constexpr Duration kSecond = Duration::seconds(1);
constexpr Duration kTwoSeconds = Duration::seconds(2);

constexpr std::int64_t kTrueNorth = table::raw_of(table::kDirectionReference, "True");
constexpr std::int64_t kMagneticNorth = table::raw_of(table::kDirectionReference, "Magnetic");

Status add(const MessageWriter& writer, std::uint8_t source, Frames& frames) {
  n2k::Frame frame;
  const Status status = writer.frame(source, frame);
  if (status == Status::kOk) frames.push_back(frame);
  return status;
}

Status add_packet(const MessageWriter& writer, const Occasion& occasion, Frames& frames) {
  if (writer.status() != Status::kOk) return writer.status();
  n2k::FastPacketFrames packet;
  const Status status = n2k::compose_fast_packet(writer.identifier(occasion.source), occasion.count, writer.bytes(), packet);
  if (status == Status::kOk) frames.insert(frames.end(), packet.begin(), packet.end());
  return status;
}

/// The rate of turn between two readings of a heading.
class TurnMeter {
 public:
  explicit TurnMeter(const vehicle::State& vehicle) : vehicle_(vehicle) {}
  RadiansPerSecond rate(Time now) {
    const std::optional<Sample> last = std::exchange(last_, Sample{.time = now, .heading = vehicle_.heading});
    if (!last || now <= last->time) return RadiansPerSecond{0.0};
    return RadiansPerSecond{wrap_to_pi(vehicle_.heading - last->heading).value / (now - last->time).to_seconds()};
  }

 private:
  struct Sample {
    Time time;
    Radians heading;
  };
  const vehicle::State& vehicle_;
  std::optional<Sample> last_;
};

Broadcast heading_of(const vehicle::State& vehicle, std::optional<MagneticField> field) {
  const auto compose = [&vehicle, field](const Occasion& o, Frames& frames) {
    const Radians shown = field ? vehicle.heading - field->variation : vehicle.heading;
    MessageWriter writer(table::kHeading);
    writer.set_raw("SID", o.count).set("Heading", wrap_to_two_pi(shown).value).set_raw("Reference", field ? kMagneticNorth : kTrueNorth);
    return add(writer, o.source, frames);
  };
  return {.message = table::kHeading, .period = kTenth, .compose = compose};
}

Broadcast turn_of(const vehicle::State& vehicle) {
  const auto compose = [meter = TurnMeter(vehicle)](const Occasion& o, Frames& frames) mutable {
    MessageWriter writer(table::kRateOfTurn);
    writer.set_raw("SID", o.count).set("Rate", meter.rate(o.now).value);
    return add(writer, o.source, frames);
  };
  return {.message = table::kRateOfTurn, .period = kTenth, .compose = compose};
}

Broadcast variation_of(MagneticField field) {
  const auto compose = [field](const Occasion& o, Frames& frames) {
    MessageWriter writer(table::kVariation);
    writer.set_raw("SID", o.count)
        .set_raw("Source", table::raw_of(table::kVariationSource, "Manual"))
        .set("Variation", field.variation.value);
    return add(writer, o.source, frames);
  };
  return {.message = table::kVariation, .period = kSecond, .compose = compose};
}

Broadcast position_of(const vehicle::State& vehicle, const n2k::LocalPlane& plane) {
  const auto compose = [&vehicle, plane](const Occasion& o, Frames& frames) {
    const Result<n2k::Geographic> place = plane.to_geographic(vehicle.position);
    if (!place.ok()) return place.status();
    MessageWriter writer(table::kPosition);
    writer.set("Latitude", place.value().latitude_deg).set("Longitude", place.value().longitude_deg);
    return add(writer, o.source, frames);
  };
  return {.message = table::kPosition, .period = kTenth, .compose = compose};
}

Broadcast course_of(const vehicle::State& vehicle) {
  const auto compose = [&vehicle](const Occasion& o, Frames& frames) {
    MessageWriter writer(table::kCourse);
    writer.set_raw("SID", o.count)
        .set_raw("COGReference", kTrueNorth)
        .set("COG", wrap_to_two_pi(vehicle.heading).value)
        .set("SOG", vehicle.speed.value);
    return add(writer, o.source, frames);
  };
  return {.message = table::kCourse, .period = kQuarter, .compose = compose};
}

Broadcast fix_of(const vehicle::State& vehicle, const n2k::LocalPlane& plane) {
  const auto compose = [&vehicle, plane](const Occasion& o, Frames& frames) {
    constexpr std::int64_t kDay_us = 86'400'000'000;
    const Result<n2k::Geographic> place = plane.to_geographic(vehicle.position);
    if (!place.ok()) return place.status();
    MessageWriter writer(table::kGnss);
    writer.set_raw("SID", o.count)
        .set_raw("Date", o.now.us / kDay_us)
        .set_raw("Time", o.now.us % kDay_us / 100)
        .set("Latitude", place.value().latitude_deg)
        .set("Longitude", place.value().longitude_deg)
        .set("Altitude", -vehicle.depth.value)
        .set_raw("GNSSType", table::raw_of(table::kGnssType, "integrated"))
        .set_raw("Method", table::raw_of(table::kGnssMethod, "Estimated (DR) mode"))
        .set_raw("Integrity", table::raw_of(table::kGnssIntegrity, "No integrity checking"))
        .set_raw("NumberOfSVs", 0)
        .set_raw("ReferenceStations", 0);
    return add_packet(writer, o, frames);
  };
  return {.message = table::kGnss, .period = kSecond, .compose = compose};
}

}  // namespace

std::unique_ptr<Sensor> make_compass(const vehicle::State& vehicle, std::optional<MagneticField> field, std::uint32_t unique_number) {
  std::vector<Broadcast> broadcasts;
  if (field) broadcasts.push_back(variation_of(*field));  // first: a heading is of no use without it
  broadcasts.push_back(heading_of(vehicle, field));
  broadcasts.push_back(turn_of(vehicle));
  const Nameplate plate{.model = "compass",
                        .device_class = 60,  // navigation
                        .device_function = 140,
                        .preferred_address = 0x24,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(plate, std::move(broadcasts));
}

std::unique_ptr<Sensor> make_speed_log(const vehicle::State& vehicle, std::uint32_t unique_number) {
  const auto compose = [&vehicle](const Occasion& o, Frames& frames) {
    MessageWriter writer(table::kSpeed);
    writer.set_raw("SID", o.count)
        .set("SpeedWaterReferenced", vehicle.speed.value)
        .set_raw("SpeedWaterReferencedType", table::raw_of(table::kWaterReference, "Doppler"));
    return add(writer, o.source, frames);
  };
  const Nameplate plate{.model = "speed log",
                        .device_class = 60,  // navigation
                        .device_function = 155,
                        .preferred_address = 0x25,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(plate, std::vector<Broadcast>{{.message = table::kSpeed, .period = kSecond, .compose = compose}});
}

std::unique_ptr<Sensor> make_depth_sensor(const vehicle::State& vehicle, std::uint32_t unique_number) {
  const auto compose = [&vehicle](const Occasion& o, Frames& frames) {
    MessageWriter writer(table::kPressure);
    writer.set_raw("SID", o.count)
        .set_raw("Instance", 0)
        .set_raw("Source", table::raw_of(table::kPressureSource, "Water"))
        .set("Pressure", n2k::gauge_pressure_pa_at(vehicle.depth));
    return add(writer, o.source, frames);
  };
  const Nameplate plate{.model = "depth sensor",
                        .device_class = 75,  // sensor communication interface
                        .device_function = 140,
                        .preferred_address = 0x26,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(plate, std::vector<Broadcast>{{.message = table::kPressure, .period = kTwoSeconds, .compose = compose}});
}

std::unique_ptr<Sensor> make_altimeter(const vehicle::State& vehicle, SeaFloor floor, std::uint32_t unique_number) {
  const auto compose = [&vehicle, floor](const Occasion& o, Frames& frames) {
    const Meters altitude = floor.depth - vehicle.depth;
    MessageWriter writer(table::kWaterDepth);
    writer.set_raw("SID", o.count).set("Offset", 0.0);
    if (altitude <= floor.reach) writer.set("Depth", altitude.value);
    return add(writer, o.source, frames);
  };
  const Nameplate plate{.model = "altimeter",
                        .device_class = 60,  // navigation
                        .device_function = 130,
                        .preferred_address = 0x2A,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(plate, std::vector<Broadcast>{{.message = table::kWaterDepth, .period = kSecond, .compose = compose}});
}

std::unique_ptr<Sensor> make_battery(const double& percent, std::uint32_t unique_number) {
  const auto compose = [&percent](const Occasion& o, Frames& frames) {
    MessageWriter writer(table::kCharge);
    writer.set_raw("SID", o.count)
        .set_raw("Instance", 0)
        .set_raw("DCType", table::raw_of(table::kDcType, "Battery"))
        .set("StateOfCharge", percent);
    return add_packet(writer, o, frames);
  };
  const Nameplate plate{.model = "battery",
                        .device_class = 35,  // electrical generation
                        .device_function = 170,
                        .preferred_address = 0x2B,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(plate,
                                  std::vector<Broadcast>{{.message = table::kCharge, .period = table::kCharge.period, .compose = compose}});
}

std::unique_ptr<Sensor> make_hull_monitor(const n2k::Hull& hull, std::uint32_t unique_number) {
  const auto compose = [&hull](const Occasion& o, Frames& frames) {
    n2k::Frame frame;
    const Status status = n2k::compose_hull(hull, o.source, frame);
    if (status == Status::kOk) frames.push_back(frame);
    return status;
  };
  const Nameplate plate{.model = "hull monitor",
                        .device_class = 75,  // sensor communication interface
                        .device_function = 150,
                        .preferred_address = 0x2C,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(plate, std::vector<Broadcast>{{.message = table::kLeak, .period = kSecond, .compose = compose}});
}

std::unique_ptr<Sensor> make_navigation(const vehicle::State& vehicle, const n2k::LocalPlane& plane, std::uint32_t unique_number) {
  const Nameplate plate{.model = "inertial navigation",
                        .device_class = 60,  // navigation
                        .device_function = 170,
                        .preferred_address = 0x27,
                        .unique_number = unique_number};
  return std::make_unique<Sensor>(plate, std::vector<Broadcast>{position_of(vehicle, plane), course_of(vehicle), fix_of(vehicle, plane)});
}

}  // namespace earshot::hil
