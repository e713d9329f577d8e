#include "firmware/runtime/intake.hpp"

#include <optional>

#include "firmware/safety/situation.hpp"

namespace earshot::runtime {
namespace {

using messages::MissionState;

/// Whether a message dated `time` may follow one dated `last`. One dated long before its arrival is a recording or comes from a stalled
/// queue; one from far ahead would pass for fresh long after its sender fell silent.
bool is_in_order(Time time, Time last, Time arrival, Duration timeout) {
  return time >= last && lies_within(time, arrival, timeout);
}

/// A date ahead of its arrival counts as the arrival: a sender whose clock is fast neither hides those that come after it nor stays fresh
/// for longer.
Time effective(Time date, Time arrival) {
  return date < arrival ? date : arrival;
}

/// Of vehicle, autopilot and hydrophone; what is older is told by the rules about its age.
constexpr Duration kStatusMaxAge = Duration::seconds(30);

}  // namespace

void hold_alarms(safety::Situation& situation) {
  if (!situation.vehicle) return;
  situation.vehicle->has_leak = situation.leak.stands();
  situation.vehicle->has_ground_fault = situation.ground_fault.stands();
}

void Intake::take(const Arrival& arrival, const messages::Navigation& navigation) {
  safety::Situation& situation = progress_.situation;
  const bool is_to_move = situation.commanded && situation.commanded->speed.value > 0.0;
  if (situation.navigation.belongs_to_another(arrival.port, arrival.time)) return situation.navigation.compare(arrival.time, navigation);
  if (!situation.navigation.take(arrival.time, navigation, is_to_move)) {
    ++progress_.counters.navigation_refused;
    return;
  }
  situation.navigation.hold(arrival.port, arrival.time);
  const messages::Navigation& fix = *situation.navigation.newest();
  situation.depth.take(fix);
  if (!is_to_move || situation.depth.is_left_alone(arrival.time)) {
    situation.place.begin(fix);
  } else if (situation.navigation.newest_is_correction()) {
    situation.place.correct(fix);
  } else {
    situation.place.take(fix, *situation.commanded, mission_.safety.vehicle);
  }
  if (progress_.state == MissionState::kSearch && situation.navigation.newest_is_correction()) {
    situation.track.correct(*situation.navigation.newest());
  } else if (progress_.state == MissionState::kSearch) {
    situation.track.take(*situation.navigation.newest());
  }
}

template <class Status>
bool Intake::take_status(Time arrival, const Status& status, std::optional<Status>& newest) {
  if (!is_in_order(status.time, newest ? newest->time : Time{}, arrival, kStatusMaxAge)) {
    ++progress_.counters.status_refused;
    return false;
  }
  newest = status;
  newest->time = effective(status.time, arrival);
  return true;
}

/// An alarm counts also where another sender, whose clock is ahead, has hidden what it says.
void Intake::take(const Arrival& arrival, const messages::VehicleStatus& status) {
  safety::Situation& situation = progress_.situation;
  const bool is_newest = take_status(arrival.time, messages::usable_part_of(status), situation.vehicle);
  if (!situation.vehicle || !lies_within(status.time, arrival.time, kStatusMaxAge)) return;
  if (is_newest || status.has_leak) situation.leak.take(arrival.time, arrival.port, status.has_leak);
  if (is_newest || status.has_ground_fault) situation.ground_fault.take(arrival.time, arrival.port, status.has_ground_fault);
  hold_alarms(situation);
}

void Intake::take(const Arrival& arrival, const messages::SnrMeasurement& measurement) {
  const Time last = progress_.snr_window.newest() ? progress_.snr_window.newest()->time : Time{};
  if (messages::is_possible_snr(measurement.snr) && is_in_order(measurement.time, last, arrival.time, mission_.snr_timeout)) {
    progress_.snr_window.take(
        {.time = effective(measurement.time, arrival.time), .snr = measurement.snr, .too_faint = measurement.too_faint});
  } else {
    ++progress_.counters.snr_refused;
  }
}

void Intake::take(const Arrival& arrival, const messages::BearingMeasurement& measurement) {
  using Verdict = detector::BearingWindow::Verdict;
  const Verdict verdict = progress_.bearings.take(arrival.time, arrival.port, measurement, mission_.snr_timeout);
  if (verdict == Verdict::kRefused) ++progress_.counters.bearings_refused;
  if (verdict == Verdict::kOfAnother) ++progress_.counters.bearings_of_others;
}

void Intake::take(const Arrival& /*arrival*/, const messages::PortReport& report) {
  for (messages::PortReport& known : progress_.ports) {
    if (known.port == report.port) {
      known = report;
      return;
    }
  }
  static_cast<void>(progress_.ports.push_back(report));  // a report of a port that cannot be: there is room for each that can
}

void Intake::take(const Arrival& arrival, const messages::AutopilotStatus& status) {
  (void)take_status(arrival.time, status, progress_.situation.autopilot);
}

void Intake::take(const Arrival& arrival, const messages::HydrophoneStatus& status) {
  (void)take_status(arrival.time, status, progress_.situation.hydrophone);
}

void Intake::take(const Arrival& /*arrival*/, const messages::UnsentSetpoints& /*unsent*/) {
  progress_.is_mute = true;
}

}  // namespace earshot::runtime
