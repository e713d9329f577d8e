#include "firmware/boards/linux/turn/turn_memory.hpp"

#include <variant>

#include "firmware/core/overloads.hpp"

namespace earshot::board {

void TurnMemory::note(const messages::Input& input) {
  last = input.arrival;
  ++inputs;
  std::visit(
      Overloads{[this](const messages::Navigation& fix) {
                  if (messages::is_usable(fix)) speed = fix.speed;
                  if (fix.time >= Time{}) ++navigation_taken;
                },
                [this](const messages::SnrMeasurement& /*measurement*/) { ++snr_taken; },
                [this](const messages::OperatorCommand& command) { is_urgent = is_urgent || command.order == messages::Order::kAbort; },
                [this](const messages::VehicleStatus& status) { is_urgent = is_urgent || status.has_leak; },
                [this](const messages::UnsentSetpoints& unsent) { unsent_setpoints = unsent.count; },
                [this, &input](const messages::PortReport& report) {
                  if (input.port < reports.size()) reports[input.port] = report;
                },
                Unheeded<messages::AutopilotStatus, messages::HydrophoneStatus, messages::BearingMeasurement>{}},
      input.value);
}

void TurnMemory::note(Time turn, const runtime::Outputs& outputs) {
  last = turn;
  is_urgent = false;
  recorded_state = outputs.health.state;
  if (outputs.setpoint) commanded_speed = outputs.setpoint->speed;
}

}  // namespace earshot::board
