#include "hil/nodes/emulated_vehicle.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "firmware/core/math.hpp"

namespace earshot::hil {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;

}  // namespace

EmulatedVehicle::EmulatedVehicle(const VehicleSetup& setup)
    : state_(setup.start),
      told_(setup.start),
      over_floor_(setup.start),
      resting_{.heading = setup.start.heading, .speed = setup.start.speed, .depth = setup.start.depth},
      limits_(setup.limits),
      source_(setup.source.position),
      battery_percent_(setup.battery_percent),
      battery_percent_per_km_(setup.battery_percent_per_km) {
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
  add("compass", [&](std::uint32_t own) { return make_compass(told_, setup.magnetic_field, own); });
  add("speed-log", [&](std::uint32_t own) { return make_speed_log(told_, own); });
  add("depth-sensor", [&](std::uint32_t own) { return make_depth_sensor(told_, own); });
  add("navigation", [&](std::uint32_t own) { return make_navigation(told_, setup.plane, own); });
  add("hydrophone", [&](std::uint32_t own) { return make_hydrophone(state_, setup.source, disturbance_.hydrophone, own); });
  add("operator", [&](std::uint32_t own) {
    auto ashore = std::make_unique<Operator>(OperatorSetup{.issuer = setup.issuer,
                                                           .utc = setup.utc,
                                                           .has_arrived = [this, within = setup.found_within] { return range() <= within; },
                                                           .unique_number = own});
    operator_ = ashore.get();
    return ashore;
  });
  add("altimeter", [&](std::uint32_t own) { return make_altimeter(over_floor_, setup.sea_floor, own); });
  add("battery", [this](std::uint32_t own) { return make_battery(battery_percent_, own); });
  add("hull-monitor", [this](std::uint32_t own) { return make_hull_monitor(disturbance_.hull, own); });
}

Meters EmulatedVehicle::range() const {
  return range_between(state_.position, source_);
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
  disturbance_ = disturbance;
  battery_percent_ = disturbance.battery_percent.value_or(battery_percent_);
  if (autopilot_ == nullptr) return;
  autopilot_->engage(!disturbance.is_disengaged);
  autopilot_->obey(!disturbance.is_obstinate);
}

void EmulatedVehicle::accept(const n2k::Frame& frame, Time now) {
  for (const auto& device : devices_) device->accept(frame, now);
}

void EmulatedVehicle::step(Time now, Frames& frames) {
  move(now);
  tell();
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

/// What the hull does, whatever its autopilot wants.
vehicle::Command EmulatedVehicle::command() const {
  vehicle::Command command = autopilot_ == nullptr ? resting_ : autopilot_->command();
  if (disturbance_.has_no_thrust) command.speed = MetersPerSecond{0.0};
  if (disturbance_.are_planes_stuck) command.depth = state_.depth;
  if (disturbance_.is_rudder_stuck) {  // always a right angle ahead of it on the side to which it turns
    const double side = turning_.value > 0.0 ? 1.0 : (turning_.value < 0.0 ? -1.0 : 0.0);
    command.heading = wrap_to_pi(state_.heading + Radians{side * kRightAngle});
  }
  return command;
}

void EmulatedVehicle::move(Time now) {
  const Time last = std::exchange(last_, now).value_or(now);
  const vehicle::State before = state_;
  state_ = vehicle::advance_for(state_, command(), limits_, now - last);
  const double seconds = (now - last).to_seconds();
  const Meters way = range_between(before.position, state_.position);
  if (!disturbance_.is_rudder_stuck && seconds > 0.0)
    turning_ = RadiansPerSecond{wrap_to_pi(state_.heading - before.heading).value / seconds};
  state_.position = state_.position + NorthEast{disturbance_.current_mps.north * seconds, disturbance_.current_mps.east * seconds};
  sailed_ += way;
  battery_percent_ = std::max(battery_percent_ - way.value * 1e-3 * battery_percent_per_km_, 0.0);
}

void EmulatedVehicle::tell() {
  over_floor_ = state_;
  over_floor_.depth += disturbance_.floor_rise;
  if (disturbance_.is_frozen) return;
  told_ = state_;
  told_.position = told_.position + disturbance_.position_error;
  told_.heading = wrap_to_pi(told_.heading + disturbance_.heading_error);
  told_.depth += disturbance_.depth_error;
}

}  // namespace earshot::hil
