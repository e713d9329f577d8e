#include "firmware/boards/linux/can/autopilot_input.hpp"

#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {

Status AutopilotInput::take(const n2k::HeardFrame& heard, const Arrival& arrival, const n2k::Directory& directory, InputSink& sink) {
  const n2k::Identifier& identifier = heard.identifier.value();
  const Result<n2k::AutopilotCondition> condition = n2k::read_autopilot_status(heard.frame.bytes());
  if (!condition.ok()) return condition.status();
  const n2k::Origin origin{.pgn = identifier.pgn, .address = identifier.source, .instance = {}};
  const n2k::SourceStatus source_status = gate_.status_of(origin, directory, arrival.mission, n2k::table::kAutopilotStatus.handover);
  if (source_status == n2k::SourceStatus::kNotChosen || source_status == n2k::SourceStatus::kHeldByAnother) return Status::kOk;
  gate_.hold(origin, directory, arrival.mission);
  ++statuses_;
  sink.take(port_, messages::AutopilotStatus{.time = arrival.mission, .follows_setpoints = condition.value().follows_setpoints});
  return Status::kOk;
}

}  // namespace earshot::board
