#pragma once

#include <cstdint>
#include <optional>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/runtime/progress.hpp"

namespace earshot::runtime {

/// Judges what enters but orders. What is taken goes into the Progress; what is refused changes nothing there but its counter. Owns
/// nothing: made where an input is judged.
class Intake {
 public:
  /// When an input came, and by which port.
  struct Arrival {
    Time time;
    std::uint8_t port = 0;
  };

  Intake(const config::Mission& mission, Progress& progress) : mission_(mission), progress_(progress) {}

  void take(const Arrival& arrival, const messages::Navigation& navigation);
  void take(const Arrival& arrival, const messages::SnrMeasurement& measurement);
  void take(const Arrival& arrival, const messages::BearingMeasurement& measurement);
  void take(const Arrival& arrival, const messages::PortReport& report);
  void take(const Arrival& arrival, const messages::VehicleStatus& status);
  void take(const Arrival& arrival, const messages::AutopilotStatus& status);
  void take(const Arrival& arrival, const messages::HydrophoneStatus& status);
  void take(const Arrival& arrival, const messages::UnsentSetpoints& unsent);

 private:
  template <class Status>
  [[nodiscard]] bool take_status(Time arrival, const Status& status, std::optional<Status>& newest);

  const config::Mission& mission_;
  Progress& progress_;
};

/// The alarms that stand, whatever the newest status says.
void hold_alarms(safety::Situation& situation);

}  // namespace earshot::runtime
