#include "firmware/wire/n2k/node/node.hpp"

#include <algorithm>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/node/information.hpp"

namespace earshot::n2k {

namespace {

constexpr std::uint8_t kHighestHeartbeat = 252;  ///< of its sequence; then it begins anew

Frame claim_frame(Name name, std::uint8_t source) {
  Frame frame;
  // An address claim is a NAME; compose() cannot fail: the group and its priority are in the table.
  frame.identifier = compose({kAddressClaimPgn, table::kAddressClaim.priority, source, kBroadcast}).value();
  for (unsigned i = 0; i < frame.data.size(); ++i) frame.data[i] = static_cast<std::uint8_t>(name >> (8U * i));
  return frame;
}

/// There is room for all that a step may send.
void append(NodeFrames& frames, Status composed, const Frame& frame) {
  if (composed == Status::kOk) static_cast<void>(frames.push_back(frame));
}

Frame request_for_claims(std::uint8_t source) {
  Frame frame;
  static_cast<void>(MessageWriter(table::kRequest).set_raw("PGN", kAddressClaimPgn).frame(source, frame));
  return frame;
}

}  // namespace

void Node::accept(const HeardFrame& heard, Time now) {
  if (!heard.identifier.ok()) return;
  const Identifier& identifier = heard.identifier.value();
  const Frame& frame = heard.frame;
  switch (identifier.pgn) {
    case kAddressClaimPgn:
      if (const std::optional<Name> name = name_in(frame)) claim_.accept(identifier.source, *name, now);
      return;
    case kRequestPgn:
      take_request(identifier, frame, now);
      return;
    case kGroupFunctionPgn:
      take_group_function(identifier, frame);
      return;
    case kTransportControlPgn:
    case kTransportDataPgn: {
      const std::optional<AddressCommand> command = commanded_.accept(identifier, frame, now);
      if (command && command->name == commanded_bits(claim_.name()) && claim_.move_to(command->address) == Status::kOk)
        ++counters_.commanded;
      return;
    }
    default:
      return;
  }
}

void Node::take_request(const Identifier& identifier, const Frame& frame, Time now) {
  const bool of_us_alone = identifier.destination != kBroadcast && identifier.destination == claim_.source();
  if (!of_us_alone && identifier.destination != kBroadcast) return;
  constexpr Signal kWanted = table::field(table::kRequest, "PGN");
  const Result<std::int64_t> wanted = decode_raw(kWanted, frame.bytes());
  if (!wanted.ok()) return;
  ++counters_.requests;
  const auto pgn = static_cast<std::uint32_t>(wanted.value());
  if (pgn == kAddressClaimPgn) return claim_.ask(now);
  if (!claim_.address()) return;
  if (pgn == kProductPgn) return ask(Answer::kProduct);
  if (pgn == kConfigurationPgn) return ask(Answer::kConfiguration);
  if (pgn == kPgnListPgn) return ask(Answer::kLists);
  if (pgn == kHeartbeatPgn) {
    heartbeat_asked_ = true;
    return;
  }
  if (!of_us_alone) return;
  if (refusals_.push_back({.pgn = pgn, .asker = identifier.source}) != Status::kOk) ++counters_.unanswered;
}

void Node::take_group_function(const Identifier& identifier, const Frame& frame) {
  if (!claim_.address() || identifier.destination != claim_.address()) return;
  const std::optional<GroupDemand> demand = read_group_demand(frame);
  if (!demand) return;
  const auto lists = [&demand](std::span<const std::uint32_t> pgns) { return std::ranges::find(pgns, demand->pgn) != pgns.end(); };
  const GroupRefusal refusal{.demand = *demand, .is_known = lists(transmitted_) || lists(received_), .asker = identifier.source};
  if (group_refusals_.push_back(refusal) != Status::kOk) ++counters_.unanswered;
}

void Node::step(Time now, NodeFrames& frames) {
  frames.clear();
  if (claim_.claim_due(now)) append(frames, Status::kOk, claim_frame(claim_.name(), claim_.source()));
  const std::optional<std::uint8_t> source = claim_.address();
  if (!source) {
    refusals_.clear();
    group_refusals_.clear();
    asked_for_claims_ = false;
    return;
  }
  if (!asked_for_claims_) {
    // Whoever hears this answers, and so do we.
    append(frames, Status::kOk, request_for_claims(*source));
    claim_.ask(now);
    asked_for_claims_ = true;
  }
  send_refusals(*source, frames);
  send_heartbeat(*source, now, frames);
  send_one_answer(*source, now, frames);
}

void Node::send_refusals(std::uint8_t source, NodeFrames& frames) {
  for (const Refusal& refusal : refusals_) {
    Frame frame;
    const Status status = MessageWriter(table::kAcknowledgement)
                              .set_raw("Control", table::raw_of(table::kIsoControl, "NAK"))
                              .set_raw("PGN", refusal.pgn)
                              .frame(source, frame, refusal.asker);
    append(frames, status, frame);
    ++counters_.refused;
  }
  refusals_.clear();
  for (const GroupRefusal& refusal : group_refusals_) {
    Frame frame;
    append(frames, compose_group_refusal(refusal, source, group_sequence_++, frame), frame);
    ++counters_.refused;
  }
  group_refusals_.clear();
}

void Node::send_heartbeat(std::uint8_t source, Time now, NodeFrames& frames) {
  const bool beat = !beat_ || now - *beat_ >= kHeartbeatPeriod;
  const bool answer = heartbeat_asked_ && (!heartbeat_ || now - *heartbeat_ >= kLeastAnswerGap);
  if (!beat && !answer) return;
  MessageWriter writer(table::kHeartbeat);
  writer.set("DataTransmitOffset", kHeartbeatPeriod.to_seconds())
      .set_raw("SequenceCounter", heartbeat_sequence_)
      .set_raw("EquipmentStatus", table::raw_of(table::kEquipmentStatus, "Operational"));
  if (controller_) writer.set_raw("Controller1State", static_cast<std::int64_t>(*controller_));
  Frame frame;
  append(frames, writer.frame(source, frame), frame);
  if (beat) beat_ = now;
  heartbeat_ = now;
  heartbeat_asked_ = false;
  heartbeat_sequence_ = heartbeat_sequence_ == kHighestHeartbeat ? std::uint8_t{0} : static_cast<std::uint8_t>(heartbeat_sequence_ + 1);
  ++counters_.heartbeats;
}

void Node::send_one_answer(std::uint8_t source, Time now, NodeFrames& frames) {
  for (std::size_t i = 0; i < kAnswers; ++i) {
    Waiting& waiting = waiting_[i];
    if (!waiting.asked || (waiting.sent && now - *waiting.sent < kLeastAnswerGap)) continue;
    waiting.asked = false;
    waiting.sent = now;
    send(static_cast<Answer>(i), source, frames);
    ++counters_.answers;
    return;
  }
}

void Node::send(Answer answer, std::uint8_t source, NodeFrames& frames) {
  std::uint8_t& sequence = waiting_[static_cast<std::size_t>(answer)].sequence;
  const auto send_packet = [&](const Message& message, const Result<Information>& information) {
    FastPacketFrames packet;
    if (!information.ok()) return;
    const Identifier identifier{message.pgn, message.priority, source, kBroadcast};
    if (compose_fast_packet(identifier, sequence++, information.value().span(), packet) != Status::kOk) return;
    for (const Frame& frame : packet) append(frames, Status::kOk, frame);
  };
  switch (answer) {
    case Answer::kProduct:
      return send_packet(table::kProduct, product_information(identity_.product));
    case Answer::kConfiguration:
      return send_packet(table::kConfiguration, configuration_information(identity_.configuration));
    case Answer::kLists:
      send_packet(table::kPgnList, pgn_list(PgnListKind::kTransmitted, transmitted_));
      return send_packet(table::kPgnList, pgn_list(PgnListKind::kReceived, received_));
  }
}

}  // namespace earshot::n2k
