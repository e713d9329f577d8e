#include "hil/nodes/emulated_vehicle.hpp"

#include <algorithm>

namespace earshot::hil {

EmulatedVehicle::EmulatedVehicle(const VehicleSetup& setup)
    : moving_(setup.start, setup.limits, setup.battery),
      resting_{.heading = setup.start.heading, .speed = setup.start.speed, .depth = setup.start.depth},
      source_(setup.source.position) {
  std::uint32_t number = setup.first_number;
  const auto add = [&](std::string_view name, const auto& make) {
    const std::uint32_t own = number++;
    if (std::ranges::find(setup.without, name) != setup.without.end()) return;
    devices_.push_back(make(own));
    names_.push_back(name);
  };
  add("autopilot", [this](std::uint32_t own) {
    auto autopilot = std::make_unique<Autopilot>(resting_, own);
    autopilot_ = autopilot.get();
    return autopilot;
  });
  add("compass", [&](std::uint32_t own) { return make_compass(moving_.reported(), setup.magnetic_field, own); });
  add("speed-log", [&](std::uint32_t own) { return make_speed_log(moving_.reported(), own); });
  add("depth-sensor", [&](std::uint32_t own) { return make_depth_sensor(moving_.reported(), own); });
  add("navigation", [&](std::uint32_t own) { return make_navigation(moving_.reported(), setup.plane, own); });
  add("hydrophone",
      [&](std::uint32_t own) { return make_hydrophone(moving_.state(), setup.source, moving_.disturbance().hydrophone, own); });
  add("operator", [&](std::uint32_t own) {
    auto ashore = std::make_unique<Operator>(OperatorSetup{.issuer = setup.issuer,
                                                           .utc = setup.utc,
                                                           .has_arrived = [this, within = setup.found_within] { return range() <= within; },
                                                           .unique_number = own,
                                                           .mark = setup.mark});
    operator_ = ashore.get();
    return ashore;
  });
  add("altimeter", [&](std::uint32_t own) { return make_altimeter(moving_.over_floor(), setup.sea_floor, own); });
  add("battery", [this](std::uint32_t own) { return make_battery(moving_.battery_percent(), own); });
  add("hull-monitor", [this](std::uint32_t own) { return make_hull_monitor(moving_.disturbance().hull, own); });
}

Meters EmulatedVehicle::range() const {
  return range_between(moving_.state().position, source_);
}

std::vector<std::string_view> EmulatedVehicle::devices() const {
  std::vector<std::string_view> names;
  for (const auto& device : devices_) names.push_back(device->name());
  return names;
}

std::optional<std::uint8_t> EmulatedVehicle::address_of(std::string_view device) const {
  const auto found = std::ranges::find(names_, device);
  return found == names_.end() ? std::nullopt : devices_[static_cast<std::size_t>(found - names_.begin())]->address();
}

void EmulatedVehicle::disturb(const Disturbance& disturbance) {
  moving_.disturb(disturbance);
  if (autopilot_ == nullptr) return;
  autopilot_->engage(!disturbance.is_disengaged);
  autopilot_->obey(!disturbance.is_obstinate);
}

void EmulatedVehicle::accept(const n2k::Frame& frame, Time now) {
  for (const auto& device : devices_) device->accept(frame, now);
}

void EmulatedVehicle::step(Time now, Frames& frames) {
  moving_.move(now, autopilot_ == nullptr ? resting_ : autopilot_->command());
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

}  // namespace earshot::hil
