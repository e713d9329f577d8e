#include "hil/nodes/autopilot.hpp"

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::hil {

Autopilot::Autopilot(const vehicle::Command& resting, std::uint32_t unique_number)
    : membership_({.model = "autopilot",
                   .device_class = 40,  // steering and control surfaces
                   .device_function = 150,
                   .preferred_address = n2k::kVehicleAddress,
                   .unique_number = unique_number},
                  {n2k::kAutopilotStatusPgn}, {n2k::kHeadingControlPgn, n2k::kSpeedDepthPgn}),
      helm_(resting) {}

void Autopilot::accept(const n2k::Frame& frame, Time now) {
  membership_.accept(frame, now);
  messages::Setpoint setpoint;
  if (!helm_.is_engaged()) return;
  if (receiver_.accept(frame, setpoint) != Status::kOk) return;
  helm_.take(setpoint, now);
  if (on_setpoint_) on_setpoint_(now, setpoint);
}

void Autopilot::step(Time now, Frames& frames) {
  membership_.step(now, frames);
  publish(now, frames);
  helm_.step(now);
}

void Autopilot::publish(Time now, Frames& frames) {
  const std::optional<std::uint8_t> source = membership_.address();
  if (!source || !pace_.is_due(now)) return;
  n2k::Frame frame;
  const n2k::AutopilotCondition condition{.follows_setpoints = helm_.is_engaged(), .heading_sequence = receiver_.last_sequence()};
  if (n2k::compose_autopilot_status(condition, *source, frame) == Status::kOk) frames.push_back(frame);
}

}  // namespace earshot::hil
