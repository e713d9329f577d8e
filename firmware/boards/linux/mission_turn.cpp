#include "firmware/boards/linux/mission_turn.hpp"

#include "firmware/boards/linux/lcm_codec.hpp"
#include "firmware/boards/linux/messages.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::board {
namespace {

template <class Message>
void append(Journal& journal, Time now, std::string_view channel, const Message& message) {
  (void)journal.append(now, channel, Encoded(message).bytes());  // the journal counts what it drops
}

const char* in_words(runtime::MissionState state) {
  switch (state) {
    case runtime::MissionState::kStandby:
      return "STANDBY";
    case runtime::MissionState::kSearch:
      return "SEARCH";
    case runtime::MissionState::kDone:
      return "DONE";
    case runtime::MissionState::kAbort:
      return "ABORT";
  }
  return "?";
}

const char* in_words(runtime::EndReason reason) {
  switch (reason) {
    case runtime::EndReason::kNone:
      return "not over";
    case runtime::EndReason::kCompleted:
      return "the source is reached";
    case runtime::EndReason::kStepsUsedUp:
      return "all steps are taken";
    case runtime::EndReason::kOperatorAbort:
      return "an operator aborted it";
    case runtime::EndReason::kNavigationStale:
      return "navigation went silent";
    case runtime::EndReason::kSnrStale:
      return "the SNR estimate went silent";
    case runtime::EndReason::kLeftOperatingArea:
      return "the vehicle left its operating area";
    case runtime::EndReason::kTimeUsedUp:
      return "its time is used up";
  }
  return "?";
}

}  // namespace

void MissionTurn::take(Time now, const runtime::Navigation& navigation) {
  append(journal_, now, wire::kNavStateChannel, to_message(navigation));
  runtime_.take(now, navigation);
}

void MissionTurn::take(Time now, const runtime::SnrEstimate& estimate) {
  append(journal_, now, wire::kSnrEstimateChannel, to_message(estimate));
  runtime_.take(now, estimate);
}

void MissionTurn::take(Time now, runtime::OperatorCommand command) {
  append(journal_, now, wire::kOperatorCommandChannel, to_message(command, now));
  runtime_.take(now, command);
}

runtime::Outputs MissionTurn::operator()(Time now) {
  const runtime::Outputs outputs = runtime_.step(now);
  record(now, outputs);
  bus_.publish(now, outputs);
  return outputs;
}

void MissionTurn::record(Time now, const runtime::Outputs& outputs) {
  append(journal_, now, wire::kSetpointChannel, to_message(outputs.setpoint, now));
  if (outputs.decision) append(journal_, now, wire::kDecisionChannel, to_message(*outputs.decision));
  append(journal_, now, wire::kHealthChannel, to_message(outputs, bus_.counters().refused_messages, now));
}

std::string in_words(const runtime::Outputs& outputs) {
  return std::string(in_words(outputs.state)) + ", " + in_words(outputs.end_reason) + ", after " + std::to_string(outputs.steps_taken) +
         " steps";
}

}  // namespace earshot::board
