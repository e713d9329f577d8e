#include "hil/nodes/lcm/lcm_vehicle.hpp"

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::hil {
namespace {

template <class Value>
void publish(std::string_view channel, const Value& value, LcmMessages& sent) {
  const wire::Encoded encoded(value);
  sent.push_back({.channel = std::string(channel), .data = {encoded.bytes().begin(), encoded.bytes().end()}});
}

}  // namespace

LcmVehicle::LcmVehicle(const LcmVehicleSetup& setup)
    : moving_(setup.start, setup.limits, setup.battery),
      helm_({.heading = setup.start.heading, .speed = setup.start.speed, .depth = setup.start.depth}),
      source_(setup.source),
      sea_floor_(setup.sea_floor) {}

Meters LcmVehicle::range() const {
  return range_between(moving_.state().position, source_.position);
}

void LcmVehicle::disturb(const Disturbance& disturbance) {
  moving_.disturb(disturbance);
  helm_.engage(!disturbance.is_disengaged);
  helm_.obey(!disturbance.is_obstinate);
}

void LcmVehicle::accept(const LcmMessage& message, Time now) {
  messages::Setpoint setpoint;
  if (message.channel != wire::kSetpointChannel || wire::decode(message.data, setpoint) != Status::kOk) return;
  helm_.take(setpoint, now);
}

void LcmVehicle::step(Time now, LcmMessages& sent) {
  moving_.move(now, helm_.command());
  helm_.step(now);
  const vehicle::State& reported = moving_.reported();
  publish(wire::kNavStateChannel,
          messages::Navigation{
              .time = now, .position = reported.position, .depth = reported.depth, .heading = reported.heading, .speed = reported.speed},
          sent);
  hear(now, sent);
  publish_hull(now, sent);
  publish(wire::kAutopilotStatusChannel, messages::AutopilotStatus{.time = now, .follows_setpoints = helm_.is_engaged()}, sent);
}

void LcmVehicle::hear(Time now, LcmMessages& sent) const {
  const HydrophoneFault& fault = moving_.disturbance().hydrophone;
  publish(wire::kHydrophoneStatusChannel, messages::HydrophoneStatus{.time = now, .is_deaf = fault.is_deaf}, sent);
  if (fault.is_deaf) return;
  publish(wire::kSnrEstimateChannel, messages::SnrMeasurement{.time = now, .snr = source_.snr(range()) + fault.gain_error}, sent);
}

void LcmVehicle::publish_hull(Time now, LcmMessages& sent) const {
  const Meters altitude = sea_floor_.depth - moving_.over_floor().depth;
  messages::VehicleStatus status{.time = now,
                                 .battery_percent = moving_.battery_percent(),
                                 .has_leak = moving_.disturbance().hull.wet.value_or(false),
                                 .has_ground_fault = moving_.disturbance().hull.has_ground_fault.value_or(false)};
  if (altitude <= sea_floor_.reach) status.altitude = altitude;
  publish(wire::kVehicleStatusChannel, status, sent);
}

}  // namespace earshot::hil
