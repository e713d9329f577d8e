#include "firmware/boards/linux/turn_memory.hpp"

#include <variant>

namespace earshot::board {

void TurnMemory::note(const messages::Input& input) {
  last = input.arrival;
  ++inputs;
  if (const auto* navigation = std::get_if<messages::Navigation>(&input.value)) {
    if (messages::is_usable(*navigation)) speed = navigation->speed;
    if (navigation->time >= Time{}) ++navigation_taken;
  }
  if (std::holds_alternative<messages::SnrMeasurement>(input.value)) ++snr_taken;
  if (const auto* unsent = std::get_if<messages::UnsentSetpoints>(&input.value)) unsent_setpoints = unsent->count;
  const auto* report = std::get_if<messages::PortReport>(&input.value);
  if (report != nullptr && input.port < reports.size()) reports[input.port] = *report;
}

void TurnMemory::note(Time turn, const runtime::Outputs& outputs) {
  last = turn;
  recorded_state = outputs.health.state;
  if (outputs.setpoint) commanded_speed = outputs.setpoint->speed;
}

}  // namespace earshot::board
