// How a Runtime keeps its memory from failing unnoticed: what comes from outside goes through here.

#include <algorithm>
#include <cassert>

#include "firmware/core/math.hpp"
#include "firmware/runtime/bytes_of_state.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::runtime {
namespace {

using messages::EndReason;
using messages::MissionState;

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

bool Runtime::is_intact() const {
  return integrity_ == kIntact && configured_ == shadow_.configured && are_same_bytes(progress_, shadow_.progress);
}

void Runtime::update_shadow() {
  copy_bytes(progress_, shadow_.progress);
}

void Runtime::update_shadow_of_mission() {
  shadow_.configured = configured_;
  copy_bytes(mission_, shadow_.mission);
}

bool Runtime::may_decide() const {
  return checksum_of(policy_) == policy_checksum_ && checksum_of(tables_) == tables_checksum_ && checksum_of(memory_) == memory_checksum_;
}

/// Nothing here is believed that a single bit could have changed by itself. A vehicle that must move to come up goes round: where it points
/// is not known, so that its heading turns on with the time.
void Runtime::step_of_damaged(Time now, Outputs& outputs) const {
  outputs = {};
  outputs.health.turn = progress_.turn;
  outputs.health.authority = messages::Authority::kAbort;
  outputs.health.state = MissionState::kAbort;
  outputs.health.end_reason = EndReason::kMemoryFault;
  const bool was_commanding = progress_.situation.commanded && shadow_.progress.situation.commanded;
  const bool was_engaged = progress_.command.is_engaged() && shadow_.progress.command.is_engaged();
  if (!was_commanding && !was_engaged) return;
  messages::Setpoint& setpoint = outputs.setpoint.emplace();
  setpoint.speed = lower_of_possible(mission_.safety.vehicle.ascent_speed, shadow_.mission.safety.vehicle.ascent_speed);
  if (setpoint.speed > kNoSpeed)
    setpoint.heading = turned_on(now, setpoint.speed, mission_.safety.vehicle.turn_radius, shadow_.mission.safety.vehicle.turn_radius);
}

Outputs Runtime::step(Time now) {
  assert(now.us >= 0);
  if (!is_intact() || !are_same_bytes(mission_, shadow_.mission)) integrity_ = 0;
  Outputs outputs;
  if (integrity_ == kIntact) turn(now, outputs);
  if (integrity_ == kIntact) {
    update_shadow();
  } else {
    step_of_damaged(now, outputs);
  }
  return outputs;  // one object: what is returned in two places lies on the stack twice
}

messages::CommandOutcome Runtime::take(const messages::Input& input) {
  assert(input.port < config::kMaxPorts);
  if (!is_intact()) integrity_ = 0;
  if (integrity_ != kIntact) return messages::CommandOutcome::kNotInThisState;
  const messages::CommandOutcome outcome = judge(input);
  update_shadow();
  return outcome;
}

}  // namespace earshot::runtime
