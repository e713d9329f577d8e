#include "firmware/boards/linux/can/order_input.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/wire/n2k/own/challenge.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {
namespace {

/// Between two challenges.
constexpr Duration kChallengePeriod = least_between(n2k::table::kChallenge.period);

}  // namespace

void OrderInput::take(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink) {
  messages::OperatorCommand command;
  std::uint8_t sender = n2k::kNullAddress;
  const std::uint64_t cut = receiver_.counters().cut;
  // Without an address only what is meant for all is for us.
  const Status status = receiver_.accept(heard, arrival.utc, device_.address().value_or(n2k::kNullAddress), command, sender);
  if (status == Status::kNotReady) return;
  if (status != Status::kOk) {
    if (const auto refusal = received_.refuse_unreadable(command, clock.now(), sink)) answer(*refusal, sender);
    return;
  }
  if (receiver_.counters().cut != cut) sink.report_order_trouble(port_, OrderTrouble::kCutAbort);
  received_.judge_mark(command, sink);
  command.time = clock.mission_time_of(command.time);
  command.expiry = clock.mission_time_of(command.expiry);
  ++taken_;
  static_cast<void>(askers_.push_back({.issuer = command.issuer, .number = command.number, .address = sender}));
  sink.take(port_, command);
}

void OrderInput::answer(const messages::CommandAcknowledgement& acknowledgement, std::uint8_t asker) {
  device_.send<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
    const n2k::Route route{.source = address, .destination = asker, .sequence = acknowledgement_sequence_++};
    return n2k::compose_acknowledgement(acknowledgement, route, frames);
  });
}

/// Orders are judged as they come, so that an acknowledgement for each has come in the same order; of those that found no room there is
/// none.
void OrderInput::acknowledge(const runtime::Outputs& outputs) {
  std::size_t next = 0;
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements) {
    if (acknowledgement.port != port_) continue;
    const auto is_asker = [&](const Asker& asker) {
      return asker.issuer == acknowledgement.issuer && asker.number == acknowledgement.number;
    };
    const auto asker = std::find_if(askers_.begin() + next, askers_.end(), is_asker);
    if (asker == askers_.end()) continue;
    next = static_cast<std::size_t>(asker - askers_.begin()) + 1;
    answer(acknowledgement, asker->address);
  }
  askers_.clear();
}

void OrderInput::publish_challenge(Time now) {
  const std::optional<host::CommandProof>& proof = received_.proof();
  if (!proof || now - challenge_published_at_ < kChallengePeriod) return;
  challenge_published_at_ = now;
  device_.send<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
    return n2k::compose_challenge(proof->published(device_.utc()), {.source = address, .sequence = challenge_sequence_++}, frames);
  });
}

}  // namespace earshot::board
