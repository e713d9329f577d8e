#include "firmware/wire/n2k/own/conditions.hpp"

#include "firmware/wire/n2k/own/fields.hpp"
#include "firmware/wire/n2k/own/ownership.hpp"

namespace earshot::n2k {
namespace {

using Bytes = std::span<const std::uint8_t>;
using messages::AutopilotStatus;
using messages::HydrophoneStatus;
using messages::VehicleStatus;

Result<bool> yes_or_no(const Signal& signal, Bytes bytes) {
  const Result<std::int64_t> raw = decode_raw(signal, bytes);
  if (!raw.ok()) return raw.status();
  if (raw.value() > 1) return Status::kOutOfRange;  // two bits may say "error", too
  return raw.value() == 1;
}

std::optional<bool> if_any(const Result<bool>& reading) {
  return reading.ok() ? std::optional(reading.value()) : std::nullopt;
}

std::optional<std::uint8_t> if_any(const Result<std::int64_t>& reading) {
  return reading.ok() ? std::optional(static_cast<std::uint8_t>(reading.value())) : std::nullopt;
}

}  // namespace

Status compose_hull(const Hull& hull, std::uint8_t source, Frame& frame) {
  MessageWriter writer = begin_own(table::kLeak);
  if (hull.instance) writer.set_raw("Instance", *hull.instance);
  if (hull.wet) writer.set_raw(kBusName<&VehicleStatus::has_leak>, *hull.wet ? 1 : 0);
  if (hull.has_ground_fault) writer.set_raw(kBusName<&VehicleStatus::has_ground_fault>, *hull.has_ground_fault ? 1 : 0);
  return writer.frame(source, frame);
}

Result<Hull> read_hull(Bytes bytes) {
  constexpr Signal kInstance = table::field(table::kLeak, "Instance");
  constexpr Signal kState = table::signal_of<&VehicleStatus::has_leak>();
  constexpr Signal kGroundFault = table::signal_of<&VehicleStatus::has_ground_fault>();
  if (!is_ours(table::kLeak, bytes)) return Status::kUnsupported;
  const Result<bool> wet = yes_or_no(kState, bytes);
  const Result<bool> fault = yes_or_no(kGroundFault, bytes);
  if (!wet.ok() && !fault.ok()) return wet.status() == Status::kNotReady ? fault.status() : wet.status();
  return Hull{.instance = if_any(decode_raw(kInstance, bytes)), .wet = if_any(wet), .has_ground_fault = if_any(fault)};
}

Status compose_autopilot_status(const AutopilotCondition& condition, std::uint8_t source, Frame& frame) {
  MessageWriter writer = begin_own(table::kAutopilotStatus);
  writer.set_raw(kBusName<&AutopilotStatus::follows_setpoints>, condition.follows_setpoints ? 1 : 0);
  if (condition.heading_sequence) writer.set_raw("HeadingSequence", *condition.heading_sequence);
  return writer.frame(source, frame);
}

Result<AutopilotCondition> read_autopilot_status(Bytes bytes) {
  constexpr Signal kFollows = table::signal_of<&AutopilotStatus::follows_setpoints>();
  constexpr Signal kSequence = table::field(table::kAutopilotStatus, "HeadingSequence");
  if (!is_ours(table::kAutopilotStatus, bytes)) return Status::kUnsupported;
  const Result<bool> follows = yes_or_no(kFollows, bytes);
  if (!follows.ok()) return follows.status();
  return AutopilotCondition{.follows_setpoints = follows.value(), .heading_sequence = if_any(decode_raw(kSequence, bytes))};
}

Status compose_deaf(bool is_deaf, std::uint8_t source, Frame& frame) {
  return begin_own(table::kSnr).set_raw(kBusName<&HydrophoneStatus::is_deaf>, is_deaf ? 1 : 0).frame(source, frame);
}

Result<bool> read_deaf(Bytes bytes) {
  constexpr Signal kDeaf = table::signal_of<&HydrophoneStatus::is_deaf>();
  if (!is_ours(table::kSnr, bytes)) return Status::kUnsupported;
  return yes_or_no(kDeaf, bytes);
}

}  // namespace earshot::n2k
