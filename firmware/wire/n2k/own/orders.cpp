#include "firmware/wire/n2k/own/orders.hpp"

#include <array>
#include <cstddef>
#include <optional>

#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {

namespace {

using messages::CommandAcknowledgement;
using messages::CommandOutcome;
using messages::OperatorCommand;
using messages::Order;

Status cut(const MessageWriter& writer, const Route& route, FastPacketFrames& frames) {
  if (writer.status() != Status::kOk) return writer.status();
  return compose_fast_packet(writer.identifier(route.source, route.destination), route.sequence, writer.bytes(), frames);
}

constexpr std::array<FieldName, 4> kMarkSignals{"Mark0", "Mark1", "Mark2", "Mark3"};

/// Four bytes of a mark, little-endian, as everything on this bus.
std::int64_t mark_part(const messages::CommandMark& mark, std::size_t part) {
  std::int64_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::int64_t{mark[4 * part + i]} << (8 * i);
  return value;
}

void put_mark_part(std::int64_t value, std::size_t part, messages::CommandMark& mark) {
  for (std::size_t i = 0; i < 4; ++i) mark[4 * part + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

/// "Not available" leaves a limit as it is; anything else that is no number is told by its status.
template <class Limit>
Status read_limit(const Signal& signal, std::span<const std::uint8_t> bytes, std::optional<Limit>& limit) {
  const Result<double> said = decode(signal, bytes);
  if (said.ok()) limit = Limit{said.value()};
  return said.status() == Status::kNotReady ? Status::kOk : said.status();
}

Result<messages::OperatorLimits> read_limits(std::span<const std::uint8_t> bytes) {
  constexpr Signal kMaxDepth = table::field(table::kCommand, "MaxDepth");
  constexpr Signal kMaxSpeed = table::field(table::kCommand, "MaxSpeed");
  constexpr Signal kMaxTime = table::field(table::kCommand, "MaxTime");
  messages::OperatorLimits limits;
  for (const Status status : {read_limit(kMaxDepth, bytes, limits.max_depth), read_limit(kMaxSpeed, bytes, limits.max_speed),
                              read_limit(kMaxTime, bytes, limits.max_time_s)}) {
    if (status != Status::kOk) return status;
  }
  return limits;
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
bool says_abort(std::span<const std::uint8_t> bytes) {
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
  MessageWriter writer = begin_own(table::kCommand);
  writer.set_raw("Order", static_cast<std::int64_t>(command.order))
      .set_raw("Issuer", command.issuer)
      .set_raw("Number", command.number)
      .set_raw("Time", command.time.us)
      .set_raw("Expiry", command.expiry.us);
  for (std::size_t i = 0; i < kMarkSignals.size(); ++i) writer.set_raw(kMarkSignals[i], mark_part(command.mark, i));
  if (command.limits.max_depth) writer.set("MaxDepth", command.limits.max_depth->value);
  if (command.limits.max_speed) writer.set("MaxSpeed", command.limits.max_speed->value);
  if (command.limits.max_time_s) writer.set("MaxTime", *command.limits.max_time_s);
  return cut(writer, route, frames);
}

Result<OperatorCommand> read_command(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kCommand, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kCommand, bytes);
  OperatorCommand command;
  command.order = static_cast<Order>(reader.raw("Order"));
  command.issuer = static_cast<std::uint32_t>(reader.raw("Issuer"));
  command.number = static_cast<std::uint32_t>(reader.raw("Number"));
  command.time = Time{reader.raw("Time")};
  command.expiry = Time{reader.raw("Expiry")};
  for (std::size_t i = 0; i < kMarkSignals.size(); ++i) put_mark_part(reader.raw(kMarkSignals[i]), i, command.mark);
  if (reader.status() != Status::kOk) return reader.status();
  const Result<messages::OperatorLimits> limits = read_limits(bytes);
  if (!limits.ok()) return limits.status();
  command.limits = limits.value();
  return command;
}

Status compose_abort(std::uint32_t issuer, std::uint32_t number, const Route& route, Frame& frame) {
  return begin_own(table::kAbort)
      .set_raw("AbortIssuer", issuer)
      .set_raw("AbortNumber", number)
      .frame(route.source, frame, route.destination);
}

Status compose_acknowledgement(const CommandAcknowledgement& acknowledgement, const Route& route, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(table::kCommandAcknowledgement);
  writer.set_raw("Order", static_cast<std::int64_t>(acknowledgement.order))
      .set_raw("Issuer", acknowledgement.issuer)
      .set_raw("Number", acknowledgement.number)
      .set_raw("Outcome", static_cast<std::int64_t>(acknowledgement.outcome))
      .set_raw("Time", acknowledgement.time.us);
  return cut(writer, route, frames);
}

Result<CommandAcknowledgement> read_acknowledgement(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kCommandAcknowledgement, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kCommandAcknowledgement, bytes);
  const std::int64_t order = reader.raw("Order");
  const std::int64_t outcome = reader.raw("Outcome");
  CommandAcknowledgement acknowledgement;
  acknowledgement.time = Time{reader.raw("Time")};
  acknowledgement.issuer = static_cast<std::uint32_t>(reader.raw("Issuer"));
  acknowledgement.number = static_cast<std::uint32_t>(reader.raw("Number"));
  if (reader.status() != Status::kOk) return reader.status();
  if (!messages::is_value_of<CommandOutcome>(outcome)) return Status::kUnsupported;
  acknowledgement.order = static_cast<Order>(order);
  acknowledgement.outcome = static_cast<CommandOutcome>(outcome);
  return acknowledgement;
}

Status OrderReceiver::accept(const Frame& frame, Time now, std::uint8_t address, OperatorCommand& command, std::uint8_t& sender) {
  const Result<Identifier> parsed = parse_identifier(frame.identifier);
  if (!parsed.ok() || parsed.value().pgn != kPeerPgn) return Status::kNotReady;
  const Identifier& identifier = parsed.value();
  if (identifier.destination != address && identifier.destination != kBroadcast) return Status::kNotReady;
  sender = identifier.source;
  if (is_ours(table::kAbort, frame.bytes()) && !assembly_.expects(identifier, frame)) return take(frame.bytes(), now, command);
  Assembled message;
  const Status status = assembly_.accept(identifier, frame, now, message);
  if (status != Status::kOk) return Status::kNotReady;
  if (identifier.destination == kBroadcast && !says_abort(message.bytes)) {
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
