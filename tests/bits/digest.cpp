#include "tests/bits/digest.hpp"

namespace earshot::bits {
namespace {

template <class Enum>
std::uint64_t number(Enum value) {
  return static_cast<std::uint64_t>(value);
}

}  // namespace

void Digest::add(const detector::Estimate& estimate) {
  add(number(estimate.hearing));
  add(std::uint64_t{estimate.too_faint});
  if (estimate.is_measured()) {  // what was not measured is a NaN, which machines write differently
    add(estimate.time);
    add(estimate.snr.value);
    add(estimate.level.value);
    add(estimate.floor.value);
  }
  if (estimate.ended) {
    add(estimate.ended->begin);
    add(static_cast<std::uint64_t>(estimate.ended->duration.us));
    add(estimate.ended->peak_level.value);
    add(estimate.ended->peak_snr.value);
  }
}

void Digest::add(const messages::BeliefSummary& belief) {
  add(belief.likeliest);
  add(belief.mean);
  add(belief.spread.value);
  add(belief.likeliest_share);
  add(belief.effective_cells);
  add(belief.mismatch_bits);
}

void Digest::add(const messages::Decision& decision) {
  add(std::uint64_t{decision.step});
  add(decision.time);
  add(decision.position);
  add(decision.snr.value);
  add(std::uint64_t{decision.too_faint} + 2 * std::uint64_t{decision.detected} + 4 * std::uint64_t{decision.sweeping} +
      8 * std::uint64_t{decision.overridden});
  add(std::uint64_t{decision.action});
  add(decision.waypoint);
  add(std::span(decision.observation).first(decision.observation_size));
  add(std::span(decision.logits).first(decision.action_count));
  add(std::uint64_t{decision.bearing.has_value()});
  if (decision.bearing) add(decision.bearing->direction.value);
  add(std::uint64_t{decision.belief.has_value()});
  if (decision.belief) add(*decision.belief);
  add(std::uint64_t{decision.found.has_value()});
  if (decision.found) {
    add(decision.found->probability);
    add(decision.found->snr.value);
    add(decision.found->least_snr.value);
    add(decision.found->closest_approach.value);
  }
}

void Digest::add(const messages::Setpoint& setpoint) {
  add(setpoint.heading.value);
  add(setpoint.speed.value);
  add(setpoint.depth.value);
  add(setpoint.waypoint);
  add(std::uint64_t{setpoint.release_weight});
}

void Digest::add(const messages::SafetyEvent& event) {
  add(event.time);
  add(std::uint64_t{event.rule});
  add(number(event.condition) + 256 * number(event.response) + 65'536 * std::uint64_t{event.begins});
  add(event.measure);
  add(event.limit);
}

void Digest::add(const messages::Health& health) {
  add(health.turn);
  add(std::uint64_t{health.decisions});
  add(std::uint64_t{health.steps_taken});
  add(number(health.state) + 256 * number(health.end_reason) + 65'536 * number(health.authority));
  add(health.mismatch_bits);
  add(health.counters.navigation_refused + health.counters.snr_refused + health.counters.status_refused + health.counters.commands_refused +
      health.counters.setpoints_limited + health.counters.bearings_refused);
}

void Digest::add(const policy::GoldenStep& step, std::size_t elements, std::size_t actions) {
  add(step.belief);
  add(std::uint64_t{step.fingerprint});
  add(std::span(step.observation).first(elements));
  add(std::span(step.logits).first(actions));
}

}  // namespace earshot::bits
