#include "firmware/wire/n2k/own/reports.hpp"

#include "firmware/messages/dictionary/output_fields.hpp"
#include "firmware/wire/n2k/own/fields.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {

namespace {

template <class Report>
Status compose(const Message& message, const Report& report, Time sent, const Sender& sender, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(message);
  write_fields(report, sent, writer);
  if (writer.status() != Status::kOk) return writer.status();
  return compose_fast_packet(writer.identifier(sender.source), sender.sequence, writer.bytes(), frames);
}

}  // namespace

Status compose_health(const messages::Health& health, Time now, const Sender& sender, FastPacketFrames& frames) {
  return compose(table::kHealth, health, now, sender, frames);
}

Result<HealthReport> read_health(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kHealth, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kHealth, bytes);
  HealthReport report;
  report.port_count = static_cast<std::uint8_t>(reader.raw("Ports"));
  if (const Status status = read_fields(reader, report.health, &report.time); status != Status::kOk) return status;
  return report;
}

Status compose_port_health(const messages::PortReport& report, const Sender& sender, FastPacketFrames& frames) {
  return compose(table::kPortHealth, report, {}, sender, frames);
}

Result<messages::PortReport> read_port_health(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kPortHealth, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kPortHealth, bytes);
  messages::PortReport report;
  if (const Status status = read_fields(reader, report); status != Status::kOk) return status;
  return report;
}

Status compose_decision(const messages::Decision& decision, const Sender& sender, FastPacketFrames& frames) {
  return compose(table::kDecision, decision, {}, sender, frames);
}

Result<messages::Decision> read_decision(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kDecision, bytes)) return Status::kUnsupported;
  constexpr Signal kSpread = table::field(table::kDecision, "Spread");
  MessageReader reader(table::kDecision, bytes);
  messages::Decision decision;
  if (decode(kSpread, bytes).status() != Status::kNotReady) decision.belief.emplace();
  if (const Status status = read_fields(reader, decision); status != Status::kOk) return status;
  return decision;
}

}  // namespace earshot::n2k
