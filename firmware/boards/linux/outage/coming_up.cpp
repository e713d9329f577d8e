#include "firmware/boards/linux/outage/coming_up.hpp"

#include <algorithm>
#include <variant>

#include "firmware/core/math.hpp"
#include "firmware/core/overloads.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::board {
namespace {

using messages::CommandOutcome;

constexpr Radians kQuarterTurn{1.5707963267948966};
/// An older heading is none.
constexpr Duration kHeadingLasts = Duration::seconds(5);

Duration time_from(Meters depth) {
  const double rises_s = safety::DepthEstimate::while_it_turns_up(depth).value / config::kSlowestAscent.value;
  return Duration{static_cast<std::int64_t>(rises_s * 1e6)} + safety::DepthEstimate::kToTurn;
}

config::VehicleLimits at_its_slowest(config::VehicleLimits vehicle) {
  vehicle.ascent_rate = config::kSlowestAscent;
  return vehicle;
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
      depth_(record.deepest),
      is_engaged_(record.is_engaged),
      is_released_(record.is_released) {
  for (const config::Rule& rule : mission.safety.rules) {
    if (rule.condition != config::Condition::kLeak || rule.response != config::Response::kRelease) continue;
    releases_after_leak_ = std::min(releases_after_leak_.value_or(rule.persistence), rule.persistence);
  }
  const bool was_over = record.end_reason != messages::EndReason::kNone;
  health_.turn = record.turn;
  health_.authority = messages::Authority::kAbort;
  health_.state = messages::MissionState::kAbort;
  health_.end_reason = was_over ? record.end_reason : messages::EndReason::kOutage;
}

std::optional<CommandOutcome> ComingUp::take(const messages::Input& input) {
  CommandOutcome outcome = CommandOutcome::kObeyed;
  std::visit(Overloads{[&](const messages::Navigation& fix) { hear(input.arrival, fix); },
                       [&](const messages::VehicleStatus& status) { hear(input, status); },
                       [&](const messages::OperatorCommand& command) { outcome = answer(input.arrival, input.port, command); },
                       [&](const messages::PortReport& report) { keep(report); },
                       Unheeded<messages::SnrMeasurement, messages::AutopilotStatus, messages::HydrophoneStatus,
                                messages::BearingMeasurement, messages::UnsentSetpoints>{}},
             input.value);
  return outcome;
}

void ComingUp::hear(Time arrival, const messages::Navigation& fix) {
  if (!messages::is_usable(fix)) return;
  fix_ = fix;
  fix_->time = arrival;
  if (began_) depth_.take(*fix_);
}

void ComingUp::hear(const messages::Input& input, const messages::VehicleStatus& status) {
  leak_.take(input.arrival, input.port, status.has_leak);
  if (!leak_.stands()) leaks_since_.reset();
  if (leak_.stands() && !leaks_since_) leaks_since_ = input.arrival;
}

void ComingUp::keep(const messages::PortReport& report) {
  const auto known = std::ranges::find(health_.ports, report.port, &messages::PortReport::port);
  if (known != health_.ports.end()) {
    *known = report;
  } else {
    static_cast<void>(health_.ports.push_back(report));
  }
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
  is_released_ = is_released_ || (releases_after_leak_ && leaks_since_ && now - *leaks_since_ >= *releases_after_leak_);
  runtime::Outputs outputs;
  if (is_engaged_) outputs.setpoint = setpoint(now);
  outputs.acknowledgements = acknowledgements_;
  acknowledgements_.clear();
  outputs.health = health_;
  return outputs;
}

bool ComingUp::has_come_up(Time now) const {
  const bool is_seen = fix_ && now - fix_->time <= kHeadingLasts;
  return (began_ && now - *began_ > long_enough_) || (is_seen && fix_->depth <= mission_.safety.vehicle.surface_depth);
}

messages::Setpoint ComingUp::setpoint(Time now) {
  const config::VehicleLimits vehicle = at_its_slowest(mission_.safety.vehicle);
  const bool is_up = now - *began_ > long_enough_ && depth_.is_up(vehicle);
  const bool must_move = vehicle.ascent_speed.value > 0.0 && !is_up;
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
  depth_.note_order(now, setpoint, vehicle);
  return setpoint;
}

}  // namespace earshot::board
