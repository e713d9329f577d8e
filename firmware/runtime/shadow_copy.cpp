#include "firmware/runtime/shadow_copy.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"
#include "firmware/runtime/bytes_of_state.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::runtime {
namespace {

/// Of any vehicle that a mission may speak of.
constexpr MetersPerSecond kMostSpeed{20.0};
constexpr MetersPerSecond kNoSpeed{0.0};

bool is_possible(MetersPerSecond speed) {
  return speed >= kNoSpeed && speed <= kMostSpeed;
}

/// Of two speeds that were one, of which a bit may have flipped. A flipped exponent or sign makes one that is impossible.
MetersPerSecond lower_of_possible(MetersPerSecond a, MetersPerSecond b) {
  if (!is_possible(a)) return is_possible(b) ? b : kNoSpeed;
  return is_possible(b) ? std::min(a, b) : a;
}

/// Of a vehicle that goes round for as long as there is time; of which circle, two memories may not agree.
Radians turned_on(Time now, MetersPerSecond speed, Meters turn_radius, Meters again) {
  constexpr Meters kWideCircle{100.0};
  const Meters radius = turn_radius == again ? safety::blind_radius(turn_radius) : kWideCircle;
  return wrap_to_pi(Radians{speed.value / radius.value * static_cast<double>(now.us) * 1e-6});
}

}  // namespace

void ShadowCopy::trust(const config::Mission& mission, const Progress& progress) {
  mark_ = kIntact;
  copy(mission);
  copy(progress);
}

void ShadowCopy::copy(const config::Mission& mission) {
  copy_bytes(mission, mission_);
}

void ShadowCopy::copy(const Progress& progress) {
  copy_bytes(progress, progress_);
}

void ShadowCopy::compare(const config::Mission& mission) {
  if (!is_trusted() || !are_same_bytes(mission, mission_)) distrust();
}

void ShadowCopy::compare(const Progress& progress) {
  if (!is_trusted() || !are_same_bytes(progress, progress_)) distrust();
}

/// Nothing here is believed that a single bit could have changed by itself. A vehicle that must move to come up goes round: where it points
/// is not known, so that its heading turns on with the time.
void ShadowCopy::bring_up(Time now, const config::Mission& mission, const Progress& progress, Outputs& outputs) const {
  outputs = {};
  outputs.health.turn = progress.turn();
  outputs.health.authority = messages::Authority::kAbort;
  outputs.health.state = messages::MissionState::kAbort;
  outputs.health.end_reason = messages::EndReason::kMemoryFault;
  const bool was_commanding = progress.intake.situation().commanded && progress_.intake.situation().commanded;
  const bool was_engaged = progress.is_engaged() && progress_.is_engaged();
  if (!was_commanding && !was_engaged) return;
  messages::Setpoint& setpoint = outputs.setpoint.emplace();
  const config::VehicleLimits& vehicle = mission.safety.vehicle;
  const config::VehicleLimits& again = mission_.safety.vehicle;
  setpoint.speed = lower_of_possible(vehicle.ascent_speed, again.ascent_speed);
  if (setpoint.speed > kNoSpeed) setpoint.heading = turned_on(now, setpoint.speed, vehicle.turn_radius, again.turn_radius);
}

}  // namespace earshot::runtime
