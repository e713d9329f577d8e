// How a Runtime searches: from what was heard on a leg to the next one.

#include <algorithm>
#include <span>

#include "firmware/detector/threshold_detector.hpp"
#include "firmware/policy/action_draw.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/runtime/bytes_of_state.hpp"
#include "firmware/runtime/intake.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::runtime {
namespace {

using messages::EndReason;
using messages::MissionState;

/// False for a NaN.
bool are_within(std::span<const float> values, double most) {
  return std::all_of(values.begin(), values.end(), [most](float value) { return double{value} >= -most && double{value} <= most; });
}

}  // namespace

NorthEast Runtime::place_in_area() const {
  return progress_.situation.navigation.newest()->position - mission_.operating_area.south_west;
}

policy::Reception Runtime::reception(Time now) const {
  const detector::WindowReception window = progress_.snr_window.reception(mission_.listening, now);
  return {.snr = window.snr, .too_faint = window.too_faint, .bearing = bearing(now)};
}

/// An array may date its bearing by less than a second earlier than the measurement that was made with it.
Time Runtime::before_newest_measurement() const {
  return progress_.snr_window.newest()->time + Duration::seconds(-1);
}

/// As the measurements are listened to: of the window, or of the newest measurement.
std::optional<messages::Bearing> Runtime::bearing(Time now) const {
  const bool is_of_newest_measurement = mission_.listening.listening == config::Listening::kNewest;
  return progress_.bearings.heard_after(is_of_newest_measurement ? before_newest_measurement()
                                                                 : now + Duration{-mission_.listening.length.us});
}

messages::BeliefSummary Runtime::belief() const {
  messages::BeliefSummary summary = memory_.belief().summary();
  summary.likeliest = summary.likeliest + mission_.operating_area.south_west;
  summary.mean = summary.mean + mission_.operating_area.south_west;
  return summary;
}

std::optional<messages::FoundDeclaration> Runtime::found() const {
  std::optional<messages::FoundDeclaration> declaration;
  if (!has_belief()) return declaration;
  declaration = memory_.belief().declaration();
  if (declaration) declaration->likeliest = declaration->likeliest + mission_.operating_area.south_west;
  return declaration;
}

/// The policy's action; that of a sweep of the area once what is heard fits nothing that the belief thinks possible.
std::size_t Runtime::choose(NorthEast position, std::span<const float> logits) {
  const std::size_t action = policy::draw_action(policy_.draw, logits, progress_.random);
  const bool calls_for_sweep = has_belief() && memory_.belief().calls_for_sweep();
  const guidance::SweepPlan plan{.area = mission_.operating_area, .margin = mission_.edge_margin, .step_length = mission_.step_length};
  return progress_.fallback.choose(calls_for_sweep, action, plan, position, std::span(policy_.actions.begin(), policy_.actions.size()));
}

void Runtime::begin_search(Time now) {
  progress_.state = MissionState::kSearch;
  progress_.situation.search_began = now;
  progress_.situation.leak.begin();
  progress_.situation.ground_fault.begin();
  hold_alarms(progress_.situation);
  progress_.situation.track.begin(*progress_.situation.navigation.newest());
  progress_.command.begin();
  progress_.snr_window.begin_leg(now);  // no leg leads to the start: its newest measurement is all that it hears
  progress_.bearings.begin_leg(before_newest_measurement());
  memory_.start(policy_.observation, tables_, place_in_area(), reception(now));
  memory_checksum_ = checksum_of(memory_);
  progress_.is_refining = has_belief();
}

void Runtime::refine() {
  if (!progress_.is_refining) return;
  if (!may_decide()) {
    integrity_ = 0;
    return;
  }
  progress_.is_refining = memory_.refine(policy_.observation, tables_);
  memory_checksum_ = checksum_of(memory_);
}

void Runtime::search(Time now, Outputs& outputs) {
  supervise(now, outputs);
  if (progress_.state != MissionState::kSearch) return;
  if (progress_.command.is_engaged() && response() > config::Response::kWarn) {
    progress_.is_interrupted = true;
    if (response() > config::Response::kSteerBack) progress_.situation.track.forget_waypoint();  // nobody goes there now
    return;
  }
  const bool has_leg = progress_.leg.length().value > 0.0;
  if (has_leg && leg_goes_on(now) && !progress_.is_interrupted) return refine();
  if (!may_decide()) {
    integrity_ = 0;
    return;
  }
  const policy::Reception reception_on_leg = reception(now);
  if (has_leg) {
    memory_.remember(policy_.observation, tables_, place_in_area(), reception_on_leg);
    memory_checksum_ = checksum_of(memory_);
    progress_.is_refining = has_belief();
    ++progress_.steps_taken;
  }
  const bool ends_here = mission_.ends_when_found && found();
  if (!ends_here && progress_.steps_taken >= mission_.max_steps) return end(MissionState::kDone, EndReason::kStepsUsedUp);
  progress_.is_interrupted = false;  // a search that goes on decides anew, from where it is
  progress_.manoeuvre.end();
  if (!decide(now, reception_on_leg, outputs.decision.emplace())) {
    outputs.decision.reset();
    progress_.situation.is_policy_unhealthy = true;
    return supervise(now, outputs);
  }
  progress_.snr_window.begin_leg(now);
  progress_.bearings.begin_leg(now);
  if (ends_here) end(MissionState::kDone, EndReason::kFound);
}

bool Runtime::leg_goes_on(Time now) const {
  if (progress_.command.is_engaged()) return !progress_.leg.is_over(progress_.situation.navigation.newest()->position);
  return (now - progress_.decided).to_seconds() * mission_.search_speed.value < progress_.leg.length().value;
}

/// @return whether the policy could
bool Runtime::decide(Time now, const policy::Reception& reception, messages::Decision& decision) {
  const NorthEast position = progress_.situation.navigation.newest()->position;
  const std::span<float> observation = std::span(decision.observation).first(policy_.observation.spec.size());
  const std::span<float> logits = std::span(decision.logits).first(policy_.actions.size());
  policy::observe(memory_, policy_.observation, observation);
  policy::find_logits(policy_, observation, logits);
  if (!are_within(observation, policy::kMostElement) || !are_within(logits, policy::kMostLogit)) return false;
  const std::size_t action = choose(position, logits);
  const safety::SafeWaypoint safe = safety::safe_waypoint(mission_, position, position + mission_.step_length * policy_.actions[action]);
  if (safe.overridden) ++progress_.counters.setpoints_limited;
  progress_.leg = guidance::Leg(position, safe.waypoint);
  if (progress_.command.is_engaged()) progress_.situation.track.set_waypoint(safe.waypoint);
  progress_.decided = now;
  ++progress_.decisions;

  decision.step = progress_.steps_taken;
  decision.time = now;
  decision.position = position;
  decision.snr = reception.snr;
  decision.too_faint = reception.too_faint;
  decision.bearing = reception.bearing;
  decision.detected = !decision.too_faint && detector::ThresholdDetector{mission_.detection_threshold}.detects(decision.snr);
  decision.action = static_cast<std::uint8_t>(action);
  decision.sweeping = progress_.fallback.is_sweeping();
  decision.overridden = safe.overridden;
  decision.waypoint = safe.waypoint;
  if (has_belief()) decision.belief = belief();
  decision.found = found();
  decision.observation_size = static_cast<std::uint8_t>(observation.size());
  decision.action_count = static_cast<std::uint8_t>(logits.size());
  return true;
}

}  // namespace earshot::runtime
