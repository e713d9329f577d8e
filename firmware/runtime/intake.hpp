#pragma once

#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/detector/bearing_window.hpp"
#include "firmware/detector/snr_window.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "firmware/safety/situation.hpp"

namespace earshot::runtime {

/// Judges what enters but orders, and remembers what it took. Owns the situation that the rules judge, the windows of measurements and
/// the newest report of each port, and counts what it refused: that changes nothing here but its counter.
/// Oracle: Intake.*
class Intake {
 public:
  /// When an input came and by which port, and the mission that it came to.
  struct Arrival {
    const config::Mission& mission;
    messages::MissionState state = messages::MissionState::kStandby;
    Time time;
    std::uint8_t port = 0;
  };

  /// Of a mission that config::check accepts.
  void configure(const config::Mission& mission);

  void take(const Arrival& arrival, const messages::Navigation& navigation);
  void take(const Arrival& arrival, const messages::SnrMeasurement& measurement);
  void take(const Arrival& arrival, const messages::BearingMeasurement& measurement);
  void take(const Arrival& arrival, const messages::PortReport& report);
  void take(const Arrival& arrival, const messages::VehicleStatus& status);
  void take(const Arrival& arrival, const messages::AutopilotStatus& status);
  void take(const Arrival& arrival, const messages::HydrophoneStatus& status);
  void take(const Arrival& arrival, const messages::UnsentSetpoints& unsent);
  /// An operator's command came that is no old recording.
  void note_operator(Time arrival) { situation_.operator_heard = arrival; }

  // Whether the newest is no older than the mission's timeout.
  [[nodiscard]] bool navigation_is_fresh(const config::Mission& mission, Time now) const;
  [[nodiscard]] bool snr_is_fresh(const config::Mission& mission, Time now) const;
  [[nodiscard]] bool autopilot_is_connected(const config::Mission& mission, Time now) const;

  /// @pre a fix was taken
  [[nodiscard]] const messages::Navigation& fix() const;
  /// What was received over the leg's listening window, and the bearing that belongs to it.
  /// @pre a measurement was taken
  [[nodiscard]] policy::Reception reception(config::ListeningWindow listening, Time now) const;
  [[nodiscard]] const safety::Situation& situation() const { return situation_; }
  [[nodiscard]] const FixedVector<messages::PortReport, config::kMaxPorts>& ports() const { return ports_; }
  /// Of navigation, SNR, status and bearings; the others are nobody's here.
  [[nodiscard]] const messages::Counters& counters() const { return counters_; }

  /// @pre navigation_is_fresh() and snr_is_fresh()
  void begin_search(Time now);
  /// What is heard from now on belongs to another leg.
  void begin_leg(Time now);
  /// It is `now` in the situation. @pre a measurement was taken
  void note_time(Time now);
  /// Since when no set-point could be sent, by whether the last one could.
  void note_mute(Time now);
  /// The fence has the vehicle, or has it no longer.
  void note_steered_back(bool is_steered_back) { situation_.is_steered_back = is_steered_back; }
  /// The policy gave a number that is none.
  void note_unhealthy_policy() { situation_.is_policy_unhealthy = true; }
  void note_waypoint(NorthEast waypoint) { situation_.track.set_waypoint(waypoint); }
  /// The vehicle does not go to its way-point for now.
  void forget_waypoint() { situation_.track.forget_waypoint(); }
  /// What the vehicle is told from `now` on. @pre a fix was taken
  void note_setpoint(Time now, const messages::Setpoint& setpoint, const config::VehicleLimits& vehicle);

 private:
  template <class Status>
  [[nodiscard]] bool take_status(Time arrival, const Status& status, std::optional<Status>& newest);
  /// The alarms that stand, whatever the newest status says.
  void hold_alarms();
  [[nodiscard]] Time before_newest_measurement() const;
  [[nodiscard]] std::optional<messages::Bearing> bearing(config::ListeningWindow listening, Time now) const;

  safety::Situation situation_;  ///< what navigation, vehicle and autopilot say
  bool is_mute_ = false;         ///< no port could send the last turn's set-point
  detector::SnrWindow snr_window_;
  detector::BearingWindow bearings_;
  messages::Counters counters_;
  FixedVector<messages::PortReport, config::kMaxPorts> ports_;
};

}  // namespace earshot::runtime
