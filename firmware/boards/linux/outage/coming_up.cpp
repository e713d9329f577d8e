#include "firmware/boards/linux/outage/coming_up.hpp"

#include <algorithm>
#include <variant>

#include "firmware/core/math.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::board {
namespace {

using messages::CommandOutcome;

constexpr Radians kQuarterTurn{1.5707963267948966};
/// An older heading is none.
constexpr Duration kHeadingLasts = Duration::seconds(5);
/// For a vehicle that goes down when it is told to come up.
constexpr double kTimeToTurnUp_s = 60.0;

Duration time_from(Meters depth) {
  return {static_cast<std::int64_t>((depth.value / config::kSlowestAscent.value + kTimeToTurnUp_s) * 1e6)};
}

}  // namespace

config::Mission limited_by(config::Mission mission, const host::SafetyRecord& record) {
  mission.max_depth = record.max_depth;
  mission.search_depth = std::min(mission.search_depth, record.max_depth);
  mission.search_speed = record.max_speed;
  mission.max_time = record.max_time;
  mission.safety.vehicle.ascent_speed = record.ascent_speed;
  mission.safety.vehicle.turn_radius = record.turn_radius;
  return mission;
}

ComingUp::ComingUp(const config::Mission& mission, const host::SafetyRecord& record)
    : mission_(limited_by(mission, record)),
      long_enough_(time_from(record.deepest)),
      is_engaged_(record.is_engaged),
      is_released_(record.is_released) {
  for (const config::Rule& rule : mission.safety.rules)
    releases_on_leak_ = releases_on_leak_ || (rule.condition == config::Condition::kLeak && rule.response == config::Response::kRelease);
  const bool was_over = record.end_reason != messages::EndReason::kNone;
  health_.turn = record.turn;
  health_.authority = messages::Authority::kAbort;
  health_.state = messages::MissionState::kAbort;
  health_.end_reason = was_over ? record.end_reason : messages::EndReason::kOutage;
}

std::optional<CommandOutcome> ComingUp::take(const messages::Input& input) {
  CommandOutcome outcome = CommandOutcome::kObeyed;
  if (const auto* fix = std::get_if<messages::Navigation>(&input.value); fix != nullptr && messages::is_usable(*fix)) {
    fix_ = *fix;
    fix_->time = input.arrival;
  }
  const auto* status = std::get_if<messages::VehicleStatus>(&input.value);
  is_released_ = is_released_ || (releases_on_leak_ && status != nullptr && status->has_leak);
  if (const auto* command = std::get_if<messages::OperatorCommand>(&input.value)) outcome = answer(input.arrival, input.port, *command);
  const auto* report = std::get_if<messages::PortReport>(&input.value);
  if (report == nullptr) return outcome;
  const auto known = std::ranges::find(health_.ports, report->port, &messages::PortReport::port);
  if (known != health_.ports.end()) {
    *known = *report;
  } else {
    static_cast<void>(health_.ports.push_back(*report));
  }
  return outcome;
}

CommandOutcome ComingUp::answer(Time arrival, std::uint8_t port, const messages::OperatorCommand& command) {
  const bool is_abort = command.order == messages::Order::kAbort;
  const CommandOutcome outcome = is_abort ? CommandOutcome::kRepeated : CommandOutcome::kNotInThisState;
  if (!is_abort) ++health_.counters.commands_refused;
  // Where there is no room its sender asks again.
  static_cast<void>(acknowledgements_.push_back(
      {.time = arrival, .port = port, .issuer = command.issuer, .number = command.number, .order = command.order, .outcome = outcome}));
  return outcome;
}

runtime::Outputs ComingUp::step(Time now) {
  if (!began_) began_ = now;
  ++health_.turn;
  runtime::Outputs outputs;
  if (is_engaged_) outputs.setpoint = setpoint(now);
  outputs.acknowledgements = acknowledgements_;
  acknowledgements_.clear();
  outputs.health = health_;
  return outputs;
}

messages::Setpoint ComingUp::setpoint(Time now) {
  const config::VehicleLimits& vehicle = mission_.safety.vehicle;
  const bool must_move = vehicle.ascent_speed.value > 0.0 && now - *began_ <= long_enough_;
  const bool is_seen = fix_ && now - fix_->time <= kHeadingLasts;
  const Radians last = fix_ ? fix_->heading : Radians{0.0};
  const Duration unseen = fix_ ? now - fix_->time : now - *began_;
  const Radians turned_on{vehicle.ascent_speed.value / safety::blind_radius(vehicle.turn_radius).value * unseen.to_seconds()};
  messages::Setpoint setpoint;
  if (fix_) setpoint.waypoint = fix_->position;
  setpoint.heading = wrap_to_pi(must_move ? last + kQuarterTurn + (is_seen ? Radians{0.0} : turned_on) : last);
  setpoint.speed = must_move ? vehicle.ascent_speed : MetersPerSecond{0.0};
  setpoint.depth = Meters{0.0};
  setpoint.release_weight = is_released_;
  return setpoint;
}

}  // namespace earshot::board
