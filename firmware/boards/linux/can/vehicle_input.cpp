#include "firmware/boards/linux/can/vehicle_input.hpp"

#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {

void VehicleInput::take(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink) {
  messages::Navigation fix;
  if (receiver_.accept(heard, arrival.mission, fix) != Status::kOk) return;
  ++fixes_;
  sink.take(port_, fix);
}

void VehicleInput::note_claim(const n2k::HeardFrame& heard) {
  messages::Navigation unused;
  if (heard.identifier.ok() && heard.identifier.value().pgn == n2k::kAddressClaimPgn) (void)receiver_.accept(heard, Time{}, unused);
}

Status VehicleInput::take_hull(const n2k::HeardFrame& heard, const Arrival& arrival) {
  return condition_.accept_hull(heard, receiver_.sensors().directory(), arrival.mission);
}

void VehicleInput::give_status(Time now, InputSink& sink) {
  messages::VehicleStatus status;
  if (condition_.give(receiver_.sensors(), now, status) != Status::kOk) return;
  ++statuses_;
  sink.take(port_, status);
}

bool VehicleInput::has_fresh_pressure(Time now) const {
  return n2k::is_fresh(receiver_.sensors().readings().pressure_pa, now, oldest_part_);
}

}  // namespace earshot::board
