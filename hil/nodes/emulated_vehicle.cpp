#include "hil/nodes/emulated_vehicle.hpp"

#include <algorithm>
#include <utility>

namespace earshot::hil {

EmulatedVehicle::EmulatedVehicle(const VehicleSetup& setup)
    : state_(setup.start),
      resting_{.heading = setup.start.heading, .speed = setup.start.speed, .depth = setup.start.depth},
      limits_(setup.limits),
      source_(setup.source.position),
      battery_percent_(setup.battery_percent),
      battery_percent_per_km_(setup.battery_percent_per_km) {
  std::uint32_t number = setup.first_number;
  const auto add = [&](std::string_view name, const auto& make) {
    const std::uint32_t own = number++;
    if (std::ranges::find(setup.without, name) == setup.without.end()) devices_.push_back(make(own));
  };
  add("autopilot", [this](std::uint32_t own) {
    auto autopilot = std::make_unique<Autopilot>(resting_, own);
    autopilot_ = autopilot.get();
    return autopilot;
  });
  add("compass", [&](std::uint32_t own) { return make_compass(state_, setup.magnetic_field, own); });
  add("speed-log", [&](std::uint32_t own) { return make_speed_log(state_, own); });
  add("depth-sensor", [&](std::uint32_t own) { return make_depth_sensor(state_, own); });
  add("navigation", [&](std::uint32_t own) { return make_navigation(state_, setup.plane, own); });
  add("hydrophone", [&](std::uint32_t own) { return make_hydrophone(state_, setup.source, own); });
  add("operator", [&](std::uint32_t own) {
    auto ashore = std::make_unique<Operator>(OperatorSetup{.issuer = setup.issuer,
                                                           .utc = setup.utc,
                                                           .has_arrived = [this, within = setup.found_within] { return range() <= within; },
                                                           .unique_number = own});
    operator_ = ashore.get();
    return ashore;
  });
  add("altimeter", [&](std::uint32_t own) { return make_altimeter(state_, setup.sea_floor, own); });
  add("battery", [this](std::uint32_t own) { return make_battery(battery_percent_, own); });
}

Meters EmulatedVehicle::range() const {
  return range_between(state_.position, source_);
}

std::vector<std::string_view> EmulatedVehicle::devices() const {
  std::vector<std::string_view> names;
  for (const auto& device : devices_) names.push_back(device->name());
  return names;
}

void EmulatedVehicle::accept(const n2k::Frame& frame, Time now) {
  for (const auto& device : devices_) device->accept(frame, now);
}

void EmulatedVehicle::step(Time now, Frames& frames) {
  move(now);
  for (const auto& device : devices_) {
    const std::size_t before = frames.size();
    device->step(now, frames);
    for (std::size_t i = before; i < frames.size(); ++i) {
      for (const auto& other : devices_) {
        if (other != device) other->accept(frames[i], now);
      }
    }
  }
}

void EmulatedVehicle::move(Time now) {
  const Time last = std::exchange(last_, now).value_or(now);
  const vehicle::Command& command = autopilot_ == nullptr ? resting_ : autopilot_->command();
  const NorthEast before = state_.position;
  state_ = vehicle::advance_for(state_, command, limits_, now - last);
  const Meters way = range_between(before, state_.position);
  sailed_ += way;
  battery_percent_ = std::max(battery_percent_ - way.value * 1e-3 * battery_percent_per_km_, 0.0);
}

}  // namespace earshot::hil
