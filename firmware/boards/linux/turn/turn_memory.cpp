#include "firmware/boards/linux/turn/turn_memory.hpp"

#include <variant>

namespace earshot::board {

namespace {

bool calls_at_once(const decltype(messages::Input::value)& value) {
  const auto* const order = std::get_if<messages::OperatorCommand>(&value);
  const auto* const status = std::get_if<messages::VehicleStatus>(&value);
  return (order != nullptr && order->order == messages::Order::kAbort) || (status != nullptr && status->has_leak);
}

}  // namespace

void TurnMemory::note(const messages::Input& input) {
  last = input.arrival;
  ++inputs;
  is_urgent = is_urgent || calls_at_once(input.value);
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
  is_urgent = false;
  recorded_state = outputs.health.state;
  if (outputs.setpoint) commanded_speed = outputs.setpoint->speed;
}

}  // namespace earshot::board
