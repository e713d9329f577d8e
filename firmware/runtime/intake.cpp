#include "firmware/runtime/intake.hpp"

#include <cassert>
#include <optional>

#include "firmware/authority/command.hpp"
#include "firmware/safety/limits.hpp"

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

void Intake::configure(const config::Mission& mission) {
  situation_.navigation = safety::NavigationJudge(mission.safety.vehicle, mission.navigation_timeout);
}

void Intake::hold_alarms() {
  if (!situation_.vehicle) return;
  situation_.vehicle->has_leak = situation_.leak.stands();
  situation_.vehicle->has_ground_fault = situation_.ground_fault.stands();
}

void Intake::take(const Arrival& arrival, const messages::Navigation& navigation) {
  const bool is_to_move = situation_.commanded && situation_.commanded->speed.value > 0.0;
  if (situation_.navigation.belongs_to_another(arrival.port, arrival.time)) return situation_.navigation.compare(arrival.time, navigation);
  if (!situation_.navigation.take(arrival.time, navigation, is_to_move)) {
    ++counters_.navigation_refused;
    return;
  }
  situation_.navigation.hold(arrival.port, arrival.time);
  const messages::Navigation& fix = *situation_.navigation.newest();
  situation_.depth.take(fix);
  if (!is_to_move || situation_.depth.is_left_alone(arrival.time)) {
    situation_.place.begin(fix);
  } else if (situation_.navigation.newest_is_correction()) {
    situation_.place.correct(fix);
  } else {
    situation_.place.take(fix, *situation_.commanded, arrival.mission.safety.vehicle);
  }
  if (arrival.state == MissionState::kSearch && situation_.navigation.newest_is_correction()) {
    situation_.track.correct(fix);
  } else if (arrival.state == MissionState::kSearch) {
    situation_.track.take(fix);
  }
}

template <class Status>
bool Intake::take_status(Time arrival, const Status& status, std::optional<Status>& newest) {
  if (!is_in_order(status.time, newest ? newest->time : Time{}, arrival, kStatusMaxAge)) {
    ++counters_.status_refused;
    return false;
  }
  newest = status;
  newest->time = effective(status.time, arrival);
  return true;
}

/// An alarm counts also where another sender, whose clock is ahead, has hidden what it says.
void Intake::take(const Arrival& arrival, const messages::VehicleStatus& status) {
  const bool is_newest = take_status(arrival.time, messages::usable_part_of(status), situation_.vehicle);
  if (!situation_.vehicle || !lies_within(status.time, arrival.time, kStatusMaxAge)) return;
  if (is_newest || status.has_leak) situation_.leak.take(arrival.time, arrival.port, status.has_leak);
  if (is_newest || status.has_ground_fault) situation_.ground_fault.take(arrival.time, arrival.port, status.has_ground_fault);
  hold_alarms();
}

void Intake::take(const Arrival& arrival, const messages::SnrMeasurement& measurement) {
  const Time last = snr_window_.newest() ? snr_window_.newest()->time : Time{};
  if (messages::is_possible_snr(measurement.snr) && is_in_order(measurement.time, last, arrival.time, arrival.mission.snr_timeout)) {
    snr_window_.take({.time = effective(measurement.time, arrival.time), .snr = measurement.snr, .too_faint = measurement.too_faint});
  } else {
    ++counters_.snr_refused;
  }
}

void Intake::take(const Arrival& arrival, const messages::BearingMeasurement& measurement) {
  using Verdict = detector::BearingWindow::Verdict;
  const Verdict verdict = bearings_.take(arrival.time, arrival.port, measurement, arrival.mission.snr_timeout);
  if (verdict == Verdict::kRefused) ++counters_.bearings_refused;
  if (verdict == Verdict::kOfAnother) ++counters_.bearings_of_others;
}

void Intake::take(const Arrival& /*arrival*/, const messages::PortReport& report) {
  for (messages::PortReport& known : ports_) {
    if (known.port == report.port) {
      known = report;
      return;
    }
  }
  static_cast<void>(ports_.push_back(report));  // a report of a port that cannot be: there is room for each that can
}

void Intake::take(const Arrival& arrival, const messages::AutopilotStatus& status) {
  (void)take_status(arrival.time, status, situation_.autopilot);
}

void Intake::take(const Arrival& arrival, const messages::HydrophoneStatus& status) {
  (void)take_status(arrival.time, status, situation_.hydrophone);
}

void Intake::take(const Arrival& /*arrival*/, const messages::UnsentSetpoints& /*unsent*/) {
  is_mute_ = true;
}

bool Intake::navigation_is_fresh(const config::Mission& mission, Time now) const {
  const std::optional<messages::Navigation>& newest = situation_.navigation.newest();
  return newest && now - newest->time <= mission.navigation_timeout;
}

bool Intake::snr_is_fresh(const config::Mission& mission, Time now) const {
  return snr_window_.newest() && now - snr_window_.newest()->time <= mission.snr_timeout;
}

bool Intake::autopilot_is_connected(const config::Mission& mission, Time now) const {
  return authority::is_connected(mission.authority, situation_.autopilot, now);
}

const messages::Navigation& Intake::fix() const {
  assert(situation_.navigation.newest());
  return *situation_.navigation.newest();
}

/// An array may date its bearing by less than a second earlier than the measurement that was made with it.
Time Intake::before_newest_measurement() const {
  return snr_window_.newest()->time + Duration::seconds(-1);
}

/// As the measurements are listened to: of the window, or of the newest measurement.
std::optional<messages::Bearing> Intake::bearing(config::ListeningWindow listening, Time now) const {
  const bool is_of_newest_measurement = listening.listening == config::Listening::kNewest;
  return bearings_.heard_after(is_of_newest_measurement ? before_newest_measurement() : now + Duration{-listening.length.us});
}

policy::Reception Intake::reception(config::ListeningWindow listening, Time now) const {
  const detector::WindowReception window = snr_window_.reception(listening, now);
  return {.snr = window.snr, .too_faint = window.too_faint, .bearing = bearing(listening, now)};
}

void Intake::begin_search(Time now) {
  situation_.search_began = now;
  situation_.leak.begin();
  situation_.ground_fault.begin();
  hold_alarms();
  situation_.track.begin(fix());
  snr_window_.begin_leg(now);  // no leg leads to the start: its newest measurement is all that it hears
  bearings_.begin_leg(before_newest_measurement());
}

void Intake::begin_leg(Time now) {
  snr_window_.begin_leg(now);
  bearings_.begin_leg(now);
}

void Intake::note_time(Time now) {
  situation_.now = now;
  situation_.snr = snr_window_.newest()->time;
}

void Intake::note_mute(Time now) {
  if (!is_mute_) {
    situation_.mute_since.reset();
  } else if (!situation_.mute_since) {
    situation_.mute_since = now;
  }
  is_mute_ = false;
}

void Intake::note_setpoint(Time now, const messages::Setpoint& setpoint, const config::VehicleLimits& vehicle) {
  situation_.depth.note_order(now, setpoint, vehicle);
  situation_.commanded = setpoint;
  situation_.goes_round = safety::goes_round(fix(), setpoint);
}

}  // namespace earshot::runtime
