#include "firmware/wire/n2k/own/orders.hpp"

#include "firmware/messages/dictionary/command_fields.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/fields.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {

namespace {

using messages::CommandAcknowledgement;
using messages::OperatorCommand;
using messages::Order;

template <class OwnMessage>
Status compose(const Message& message, const OwnMessage& own, const Route& route, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(message);
  write_fields(own, {}, writer);
  if (writer.status() != Status::kOk) return writer.status();
  return compose_fast_packet(writer.identifier(route.source, route.destination), route.sequence, writer.bytes(), frames);
}

/// What is readable of a command: what is not is zero.
OperatorCommand head_of(std::span<const std::uint8_t> bytes, Time arrival) {
  const auto readable = [bytes](FieldName name) { return MessageReader(table::kCommand, bytes).raw(name); };
  return {.time = arrival,
          .expiry = arrival,
          .issuer = static_cast<std::uint32_t>(readable("Issuer")),
          .number = static_cast<std::uint32_t>(readable("Number")),
          .order = static_cast<Order>(readable("Order"))};
}

/// In whichever of its two forms.
bool is_abort_order(std::span<const std::uint8_t> bytes) {
  return is_ours(table::kAbort, bytes) || (is_ours(table::kCommand, bytes) && head_of(bytes, Time{}).order == Order::kAbort);
}

/// An abort is given when it arrives, and it does not expire.
Result<OperatorCommand> read_abort(std::span<const std::uint8_t> bytes, Time arrival) {
  MessageReader reader(table::kAbort, bytes);
  const OperatorCommand command{.time = arrival,
                                .expiry = arrival,
                                .issuer = static_cast<std::uint32_t>(reader.raw("AbortIssuer")),
                                .number = static_cast<std::uint32_t>(reader.raw("AbortNumber")),
                                .order = Order::kAbort};
  if (reader.status() != Status::kOk) return reader.status();
  return command;
}

}  // namespace

Status compose_command(const OperatorCommand& command, const Route& route, FastPacketFrames& frames) {
  return compose(table::kCommand, command, route, frames);
}

Result<OperatorCommand> read_command(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kCommand, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kCommand, bytes);
  OperatorCommand command;
  if (const Status status = read_fields(reader, command); status != Status::kOk) return status;
  return command;
}

Status compose_abort(std::uint32_t issuer, std::uint32_t number, const Route& route, Frame& frame) {
  return begin_own(table::kAbort)
      .set_raw("AbortIssuer", issuer)
      .set_raw("AbortNumber", number)
      .frame(route.source, frame, route.destination);
}

Status compose_acknowledgement(const CommandAcknowledgement& acknowledgement, const Route& route, FastPacketFrames& frames) {
  return compose(table::kCommandAcknowledgement, acknowledgement, route, frames);
}

Result<CommandAcknowledgement> read_acknowledgement(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kCommandAcknowledgement, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kCommandAcknowledgement, bytes);
  CommandAcknowledgement acknowledgement;
  if (const Status status = read_fields(reader, acknowledgement); status != Status::kOk) return status;
  return acknowledgement;
}

Status OrderReceiver::accept(const HeardFrame& heard, Time now, std::uint8_t address, OperatorCommand& command, std::uint8_t& sender) {
  if (!heard.identifier.ok() || heard.identifier.value().pgn != kPeerPgn) return Status::kNotReady;
  const Identifier& identifier = heard.identifier.value();
  const Frame& frame = heard.frame;
  if (identifier.destination != address && identifier.destination != kBroadcast) return Status::kNotReady;
  sender = identifier.source;
  if (is_ours(table::kAbort, frame.bytes()) && !assembly_.expects(identifier, frame)) return take(frame.bytes(), now, command);
  Assembled message;
  const Status status = assembly_.accept(identifier, frame, now, message);
  if (status != Status::kOk) return Status::kNotReady;
  if (identifier.destination == kBroadcast && !is_abort_order(message.bytes)) {
    ++counters_.other;
    return Status::kNotReady;
  }
  return take(message.bytes, now, command);
}

Status OrderReceiver::take(std::span<const std::uint8_t> bytes, Time now, OperatorCommand& command) {
  const bool aborts = is_ours(table::kAbort, bytes);
  if (!aborts && !is_ours(table::kCommand, bytes)) {
    ++counters_.other;
    return Status::kNotReady;
  }
  const Result<OperatorCommand> read = aborts ? read_abort(bytes, now) : read_command(bytes);
  command = read.ok() ? read.value() : head_of(bytes, now);
  const bool is_cut_abort = !read.ok() && !aborts && command.order == Order::kAbort;
  if (is_cut_abort) ++counters_.cut;
  ++(read.ok() || is_cut_abort ? counters_.taken : counters_.refused);
  if (read.ok() || is_cut_abort) return Status::kOk;
  return read.status() == Status::kNotReady ? Status::kMalformed : read.status();  // "not available" where an order must say
}

}  // namespace earshot::n2k
