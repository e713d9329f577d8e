#include "firmware/runtime/search.hpp"

#include "firmware/detector/threshold_detector.hpp"
#include "firmware/safety/limits.hpp"

namespace earshot::runtime {
namespace {

using messages::EndReason;
using messages::MissionState;

}  // namespace

Status Search::begin(Time now) {
  if (!agent_.is_intact()) return Status::kCorrupt;
  progress_.begin_search(now);
  agent_.start(mission_, progress_.intake.fix().position, progress_.intake.reception(mission_.listening, now));
  progress_.is_refining = agent_.has_belief();
  return Status::kOk;
}

Status Search::refine() {
  if (!progress_.is_refining) return Status::kOk;
  if (!agent_.is_intact()) return Status::kCorrupt;
  progress_.is_refining = agent_.refine();
  return Status::kOk;
}

Status Search::turn(Time now, Outputs& outputs) {
  progress_.supervise(mission_, now, outputs.safety_events);
  if (progress_.state() != MissionState::kSearch) return Status::kOk;
  if (progress_.is_engaged() && progress_.response() > config::Response::kWarn) {
    progress_.interrupt();
    return Status::kOk;
  }
  return progress_.leg_goes_on(mission_, now) ? refine() : end_leg(now, outputs);
}

Status Search::end_leg(Time now, Outputs& outputs) {
  if (!agent_.is_intact()) return Status::kCorrupt;
  const policy::Reception reception = progress_.intake.reception(mission_.listening, now);
  if (progress_.legs.has_begun()) {
    agent_.remember(mission_, progress_.intake.fix().position, reception);
    progress_.is_refining = agent_.has_belief();
    progress_.legs.count_step();
  }
  const bool ends_here = mission_.ends_when_found && agent_.has_found();
  if (!ends_here && progress_.legs.steps_taken() >= mission_.max_steps) {
    progress_.end(MissionState::kDone, EndReason::kStepsUsedUp);
    return Status::kOk;
  }
  progress_.decide_anew();
  if (!decide(now, reception, outputs.decision.emplace())) {
    outputs.decision.reset();
    progress_.intake.note_unhealthy_policy();
    progress_.supervise(mission_, now, outputs.safety_events);
    return Status::kOk;
  }
  progress_.intake.begin_leg(now);
  if (ends_here) progress_.end(MissionState::kDone, EndReason::kFound);
  return Status::kOk;
}

/// @return whether the policy could
bool Search::decide(Time now, const policy::Reception& reception, messages::Decision& decision) {
  const NorthEast position = progress_.intake.fix().position;
  if (!agent_.observe(mission_, decision)) return false;
  const std::size_t action = agent_.choose(mission_, decision, position, progress_.random, progress_.fallback);
  const safety::SafeWaypoint safe =
      safety::safe_waypoint(mission_, position, position + mission_.step_length * agent_.direction_of(action));
  progress_.begin_leg(safe, now);

  decision.step = progress_.legs.steps_taken();
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
  return true;
}

}  // namespace earshot::runtime
