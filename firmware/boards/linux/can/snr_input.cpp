#include "firmware/boards/linux/can/snr_input.hpp"

#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {

Status SnrInput::take(const n2k::HeardFrame& heard, const Arrival& arrival, const n2k::Directory& directory, InputSink& sink) {
  const n2k::Identifier& identifier = heard.identifier.value();
  const Result<n2k::HeardSnr> condition = n2k::read_snr(heard.frame.bytes());
  const Result<bool> deaf = n2k::read_deaf(heard.frame.bytes());
  const Status status = condition.ok() || condition.status() == Status::kNotReady ? deaf.status() : condition.status();
  if (!condition.ok() && !deaf.ok()) return status;
  const n2k::Origin origin{.pgn = identifier.pgn, .address = identifier.source, .instance = {}};
  const n2k::SourceStatus source_status = gate_.status_of(origin, directory, arrival.mission, n2k::table::kSnr.handover);
  if (source_status == n2k::SourceStatus::kNotChosen && condition.ok()) ++not_chosen_;
  if (source_status == n2k::SourceStatus::kNotChosen || source_status == n2k::SourceStatus::kHeldByAnother) return status;
  report_hearing(deaf, condition.ok(), origin.address, arrival, sink);
  if (!condition.ok()) return status;
  gate_.hold(origin, directory, arrival.mission);
  ++measurements_;
  sink.take(port_, n2k::measurement_of(condition.value(), arrival.mission));
  return status;
}

/// Of the hydrophone that the SNR is taken from. Once another is, which does not say of itself, the deafness of the one before is over.
void SnrInput::report_hearing(const Result<bool>& deaf, bool has_snr, std::uint8_t source, const Arrival& arrival, InputSink& sink) {
  const bool is_replaced = has_snr && deaf_address_ && *deaf_address_ != source;
  if (!deaf.ok() && !is_replaced) return;
  const bool is_deaf = deaf.ok() && deaf.value();
  deaf_address_ = is_deaf ? std::optional(source) : std::nullopt;
  sink.take(port_, messages::HydrophoneStatus{.time = arrival.mission, .is_deaf = is_deaf});
}

}  // namespace earshot::board
