// CanPort: orders, their answers, and what they are marked for.

#include <algorithm>
#include <cstddef>

#include "firmware/boards/linux/can/can_port.hpp"
#include "firmware/wire/n2k/own/challenge.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {
namespace {

/// Between two challenges, at least: the table's period, less what turns of one second are apart from a second.
constexpr Duration kChallengePeriod{n2k::table::kChallenge.period.us * 9 / 10};

}  // namespace

void CanPort::take_order(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink) {
  messages::OperatorCommand command;
  std::uint8_t sender = n2k::kNullAddress;
  const std::uint64_t cut = orders_.counters().cut;
  // Without an address only what is meant for all is for us.
  const Status status = orders_.accept(heard, arrival.utc, node_.address().value_or(n2k::kNullAddress), command, sender);
  if (status == Status::kNotReady) return;
  if (status != Status::kOk) {
    sink.report_order_trouble(index(), OrderTrouble::kUnreadable);
    answer_unreadable(clock.now(), command, sender);
    return;
  }
  if (orders_.counters().cut != cut) sink.report_order_trouble(index(), OrderTrouble::kCutAbort);
  judge_mark(command_proof_, command, sink);
  command.time = clock.mission_time_of(command.time);
  command.expiry = clock.mission_time_of(command.expiry);
  ++report_.received;
  static_cast<void>(askers_.push_back({.issuer = command.issuer, .number = command.number, .address = sender}));
  sink.take(index(), command);
}

/// At once, and from here: what is no order is no input. A flood is answered no more often than orders are.
void CanPort::answer_unreadable(Time now, const messages::OperatorCommand& command, std::uint8_t sender) {
  if (++unreadable_answered_ > config::kMaxAcknowledgements) return;
  send_composed<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
    const n2k::Route route{.source = address, .destination = sender, .sequence = sequences_.acknowledgement++};
    const messages::CommandAcknowledgement answer{.time = now,
                                                  .port = index(),
                                                  .issuer = command.issuer,
                                                  .number = command.number,
                                                  .order = command.order,
                                                  .outcome = messages::CommandOutcome::kUnreadable};
    return n2k::compose_acknowledgement(answer, route, frames);
  });
}

/// Orders are judged as they come, so that an acknowledgement for each has come in the same order; of those that found no room there is
/// none.
void CanPort::acknowledge(const runtime::Outputs& outputs) {
  std::size_t next = 0;
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements) {
    if (acknowledgement.port != index()) continue;
    const auto is_asker = [&](const Asker& asker) {
      return asker.issuer == acknowledgement.issuer && asker.number == acknowledgement.number;
    };
    const auto asker = std::find_if(askers_.begin() + next, askers_.end(), is_asker);
    if (asker == askers_.end()) continue;
    next = static_cast<std::size_t>(asker - askers_.begin()) + 1;
    send_composed<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
      const n2k::Route route{.source = address, .destination = asker->address, .sequence = sequences_.acknowledgement++};
      return n2k::compose_acknowledgement(acknowledgement, route, frames);
    });
  }
  askers_.clear();
}

void CanPort::publish_challenge(Time now) {
  if (!command_proof_ || now - challenge_published_at_ < kChallengePeriod) return;
  challenge_published_at_ = now;
  send_composed<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
    return n2k::compose_challenge(command_proof_->published(host_.utc()), {.source = address, .sequence = sequences_.challenge++}, frames);
  });
}

}  // namespace earshot::board
