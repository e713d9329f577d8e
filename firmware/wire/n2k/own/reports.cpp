#include "firmware/wire/n2k/own/reports.hpp"

#include <algorithm>

#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {

namespace {

/// What a counter's field can hold of it.
std::int64_t counted(std::uint64_t count) {
  constexpr Signal kCounter = table::counter("", 0);
  return static_cast<std::int64_t>(std::min(count, static_cast<std::uint64_t>(kCounter.highest_raw)));
}

Status cut(const MessageWriter& writer, const Sender& sender, FastPacketFrames& frames) {
  if (writer.status() != Status::kOk) return writer.status();
  return compose_fast_packet(writer.identifier(sender.source), sender.sequence, writer.bytes(), frames);
}

std::uint64_t count_in(MessageReader& reader, FieldName signal) {
  return static_cast<std::uint64_t>(reader.raw(signal));
}

/// What its field can hold of it; a NaN stays "not available".
void set_surprise(float surprise_bits, MessageWriter& writer) {
  constexpr Signal kSurprise = table::field(table::kHealth, "Surprise");
  if (surprise_bits != surprise_bits) return;
  writer.set("Surprise", std::clamp(double{surprise_bits}, kSurprise.lowest, kSurprise.highest));
}

/// The rest of a health message, which vehicles of before do not send: what is not there stays as it is.
Status read_search(std::span<const std::uint8_t> bytes, messages::Health& health) {
  constexpr Signal kSweeping = table::field(table::kHealth, "Sweeping");
  constexpr Signal kFound = table::field(table::kHealth, "Found");
  constexpr Signal kResponse = table::field(table::kHealth, "Response");
  constexpr Signal kSurprise = table::field(table::kHealth, "Surprise");
  const auto says_yes = [bytes](const Signal& signal) {
    const Result<std::int64_t> raw = decode_raw(signal, bytes);
    return raw.ok() && raw.value() == 1;
  };
  health.is_sweeping = says_yes(kSweeping);
  health.is_found = says_yes(kFound);
  if (const Result<double> surprise = decode(kSurprise, bytes); surprise.ok()) health.surprise_bits = static_cast<float>(surprise.value());
  const Result<std::int64_t> response = decode_raw(kResponse, bytes);
  if (!response.ok()) return Status::kOk;
  if (!messages::is_value_of<config::Response>(response.value())) return Status::kUnsupported;
  health.response = static_cast<config::Response>(response.value());
  return Status::kOk;
}

NorthEast place_in(MessageReader& reader, FieldName north, FieldName east) {
  const Meters northward{reader.value(north)};
  return {.north = northward, .east = Meters{reader.value(east)}};
}

}  // namespace

Status compose_health(const messages::Health& health, Time now, const Sender& sender, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(table::kHealth);
  writer.set_raw("Time", now.us)
      .set_raw("State", static_cast<std::int64_t>(health.state))
      .set_raw("EndReason", static_cast<std::int64_t>(health.end_reason))
      .set_raw("StepsTaken", health.steps_taken)
      .set_raw("NavigationRefused", counted(health.counters.navigation_refused))
      .set_raw("SNRRefused", counted(health.counters.snr_refused))
      .set_raw("CommandsRefused", counted(health.counters.commands_refused))
      .set_raw("SetpointsLimited", counted(health.counters.setpoints_limited))
      .set_raw("StatusRefused", counted(health.counters.status_refused))
      .set_raw("Ports", static_cast<std::int64_t>(health.ports.size()))
      .set_raw("Turn", counted(health.turn))
      .set_raw("Decisions", health.decisions)
      .set_raw("Authority", static_cast<std::int64_t>(health.authority))
      .set_raw("Paused", health.is_paused ? 1 : 0)
      .set_raw("Sweeping", health.is_sweeping ? 1 : 0)
      .set_raw("Found", health.is_found ? 1 : 0)
      .set_raw("Response", static_cast<std::int64_t>(health.response));
  set_surprise(health.surprise_bits, writer);
  return cut(writer, sender, frames);
}

Result<HealthReport> read_health(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kHealth, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kHealth, bytes);
  HealthReport report;
  report.time = Time{reader.raw("Time")};
  const std::int64_t state = reader.raw("State");
  const std::int64_t reason = reader.raw("EndReason");
  report.health.steps_taken = static_cast<std::uint32_t>(reader.raw("StepsTaken"));
  report.health.counters = {.navigation_refused = count_in(reader, "NavigationRefused"),
                            .snr_refused = count_in(reader, "SNRRefused"),
                            .status_refused = count_in(reader, "StatusRefused"),
                            .commands_refused = count_in(reader, "CommandsRefused"),
                            .setpoints_limited = count_in(reader, "SetpointsLimited")};
  report.health.turn = count_in(reader, "Turn");
  report.health.decisions = static_cast<std::uint32_t>(reader.raw("Decisions"));
  report.health.is_paused = reader.yes("Paused");
  const std::int64_t authority = reader.raw("Authority");
  report.port_count = static_cast<std::uint8_t>(reader.raw("Ports"));
  if (reader.status() != Status::kOk) return reader.status();
  const bool known = messages::is_value_of<messages::MissionState>(state) && messages::is_value_of<messages::EndReason>(reason) &&
                     messages::is_value_of<messages::Authority>(authority);
  if (!known) return Status::kUnsupported;
  if (const Status status = read_search(bytes, report.health); status != Status::kOk) return status;
  report.health.authority = static_cast<messages::Authority>(authority);
  report.health.state = static_cast<messages::MissionState>(state);
  report.health.end_reason = static_cast<messages::EndReason>(reason);
  return report;
}

Status compose_port_health(const messages::PortReport& report, const Sender& sender, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(table::kPortHealth);
  writer.set_raw("Port", report.port)
      .set_raw("LinkUp", report.link_up ? 1 : 0)
      .set_raw("Received", counted(report.received))
      .set_raw("Lost", counted(report.lost))
      .set_raw("Malformed", counted(report.malformed))
      .set_raw("Unsent", counted(report.unsent));
  return cut(writer, sender, frames);
}

Result<messages::PortReport> read_port_health(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kPortHealth, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kPortHealth, bytes);
  const messages::PortReport report{.port = static_cast<std::uint8_t>(reader.raw("Port")),
                                    .link_up = reader.yes("LinkUp"),
                                    .received = count_in(reader, "Received"),
                                    .lost = count_in(reader, "Lost"),
                                    .malformed = count_in(reader, "Malformed"),
                                    .unsent = count_in(reader, "Unsent")};
  if (reader.status() != Status::kOk) return reader.status();
  return report;
}

Status compose_decision(const messages::Decision& decision, const Sender& sender, FastPacketFrames& frames) {
  MessageWriter writer = begin_own(table::kDecision);
  writer.set_raw("Time", decision.time.us)
      .set_raw("Step", decision.step)
      .set("North", decision.position.north.value)
      .set("East", decision.position.east.value)
      .set("SNR", decision.snr.value)
      .set_raw("TooFaint", decision.too_faint ? 1 : 0)
      .set_raw("Detected", decision.detected ? 1 : 0)
      .set_raw("Overridden", decision.overridden ? 1 : 0)
      .set_raw("Action", decision.action)
      .set("WaypointNorth", decision.waypoint.north.value)
      .set("WaypointEast", decision.waypoint.east.value);
  if (decision.belief) {
    const messages::BeliefSummary& belief = *decision.belief;
    writer.set("LikeliestNorth", belief.likeliest.north.value)
        .set("LikeliestEast", belief.likeliest.east.value)
        .set("MeanNorth", belief.mean.north.value)
        .set("MeanEast", belief.mean.east.value)
        .set("Spread", belief.spread.value)
        .set("LikeliestShare", static_cast<double>(belief.likeliest_share))
        .set("EffectiveCells", static_cast<double>(belief.effective_cells));
  }
  return cut(writer, sender, frames);
}

Result<messages::Decision> read_decision(std::span<const std::uint8_t> bytes) {
  if (!is_ours(table::kDecision, bytes)) return Status::kUnsupported;
  MessageReader reader(table::kDecision, bytes);
  messages::Decision decision;
  decision.time = Time{reader.raw("Time")};
  decision.step = static_cast<std::uint32_t>(reader.raw("Step"));
  decision.position = place_in(reader, "North", "East");
  decision.snr = Decibels{reader.value("SNR")};
  decision.too_faint = reader.yes("TooFaint");
  decision.detected = reader.yes("Detected");
  decision.overridden = reader.yes("Overridden");
  decision.action = static_cast<std::uint8_t>(reader.raw("Action"));
  decision.waypoint = place_in(reader, "WaypointNorth", "WaypointEast");
  if (reader.status() != Status::kOk) return reader.status();
  constexpr Signal kSpread = table::field(table::kDecision, "Spread");
  if (decode(kSpread, bytes).status() == Status::kNotReady) return decision;
  messages::BeliefSummary belief;
  belief.likeliest = place_in(reader, "LikeliestNorth", "LikeliestEast");
  belief.mean = place_in(reader, "MeanNorth", "MeanEast");
  belief.spread = Meters{reader.value("Spread")};
  belief.likeliest_share = static_cast<float>(reader.value("LikeliestShare"));
  belief.effective_cells = static_cast<float>(reader.value("EffectiveCells"));
  if (reader.status() != Status::kOk) return reader.status();
  decision.belief = belief;
  return decision;
}

}  // namespace earshot::n2k
