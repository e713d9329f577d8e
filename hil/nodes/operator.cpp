#include "hil/nodes/operator.hpp"

#include <algorithm>
#include <utility>

#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/challenge.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::hil {

using messages::MissionState;
using messages::Order;

namespace {

/// Before an order that was refused is given anew.
constexpr Duration kAfterRefusal = Duration::seconds(5);

}  // namespace

Operator::Operator(OperatorSetup setup)
    : setup_(std::move(setup)),
      membership_({.model = "operator",
                   .device_class = 70,  // communication
                   .device_function = 160,
                   .preferred_address = 0x29,
                   .unique_number = setup_.unique_number},
                  {n2k::kPeerPgn}, {n2k::kPeerPgn, n2k::kHealthPgn, n2k::kDecisionPgn, n2k::kChallengePgn}) {}

void Operator::accept(const n2k::Frame& frame, Time now) {
  membership_.accept(frame, now);
  const Result<n2k::Identifier> parsed = n2k::parse_identifier(frame.identifier);
  if (!parsed.ok()) return;
  const n2k::Identifier& identifier = parsed.value();
  const bool is_for_us = identifier.pgn == n2k::kPeerPgn && identifier.destination == membership_.address();
  const bool is_published =
      identifier.pgn == n2k::kHealthPgn || identifier.pgn == n2k::kDecisionPgn || identifier.pgn == n2k::kChallengePgn;
  if (!is_for_us && !is_published) return;
  std::span<const std::uint8_t> bytes;
  if (assembly_.accept(identifier, frame, bytes) != Status::kOk) return;
  if (const auto report = n2k::read_health(bytes); identifier.pgn == n2k::kHealthPgn && report.ok())
    take_health(identifier.source, report.value());
  if (const auto published = n2k::read_challenge(bytes); identifier.pgn == n2k::kChallengePgn && published.ok())
    challenge_ = published.value();
  if (const auto answer = n2k::read_acknowledgement(bytes); is_for_us && answer.ok()) take_answer(answer.value(), now);
  if (const auto decision = n2k::read_decision(bytes); identifier.pgn == n2k::kDecisionPgn && decision.ok()) {
    decision_ = decision.value();
    ++decisions_;
  }
}

void Operator::take_health(std::uint8_t source, const n2k::HealthReport& report) {
  const bool has_come_into_standby =
      report.health.state == MissionState::kStandby && health_ && health_->health.state != MissionState::kStandby;
  if (has_come_into_standby) has_started_ = has_completed_ = false;  // another earshotd, which remembers nothing
  vehicle_ = source;
  health_ = report;
}

void Operator::take_answer(const messages::CommandAcknowledgement& answer, Time now) {
  if (answer.issuer != setup_.issuer) return;
  const auto asked = std::ranges::find_if(waiting_, [&](const Waiting& w) { return w.command.number == answer.number; });
  if (asked == waiting_.end()) return;  // a repetition's, or none of ours
  waiting_.erase(asked);
  answers_.push_back(answer);
  if (messages::was_obeyed(answer.outcome)) return;
  rests_until_ = now + kAfterRefusal;
  if (answer.order == Order::kStart) has_started_ = false;  // to be given anew while there is reason
  if (answer.order == Order::kComplete) has_completed_ = false;
}

bool Operator::is_waiting(Order order) const {
  return std::ranges::any_of(waiting_, [order](const Waiting& w) { return w.command.order == order; });
}

void Operator::give(Order order) {
  const Time given = setup_.utc();
  waiting_.push_back(
      {.command = {.time = given, .expiry = given + kOrderLife, .issuer = setup_.issuer, .number = ++number_, .order = order}});
}

void Operator::abort() {
  if (!is_waiting(Order::kAbort)) give(Order::kAbort);
}

void Operator::give_what_is_due(Time now) {
  if (!health_ || now < rests_until_) return;
  const MissionState state = health_->health.state;
  if (state == MissionState::kStandby && !std::exchange(has_started_, true)) give(Order::kStart);
  const bool has_arrived = state == MissionState::kSearch && setup_.has_arrived && setup_.has_arrived();
  if (has_arrived && !std::exchange(has_completed_, true)) give(Order::kComplete);
}

/// An ABORT is repeated until it is answered; of the others nobody would obey what is too old: they are given anew while there is reason.
void Operator::forget_expired() {
  const Time utc = setup_.utc();
  std::erase_if(waiting_, [&](const Waiting& w) {
    const bool is_expired = w.command.order != Order::kAbort && utc > w.command.expiry;
    if (is_expired && w.command.order == Order::kStart) has_started_ = false;
    if (is_expired && w.command.order == Order::kComplete) has_completed_ = false;
    return is_expired;
  });
}

void Operator::step(Time now, Frames& frames) {
  membership_.step(now, frames);
  const std::optional<std::uint8_t> source = membership_.address();
  if (!source) return;
  give_what_is_due(now);
  forget_expired();
  for (Waiting& waiting : waiting_) {
    if (!waiting.pace.is_due(now)) continue;
    if (send(waiting, *source, frames) == Status::kOk) ++sent_;
  }
}

Status Operator::send(Waiting& waiting, std::uint8_t source, Frames& frames) {
  const n2k::Route route{.source = source, .destination = vehicle_.value_or(n2k::kBroadcast), .sequence = sequence_++};
  if (waiting.command.order == Order::kAbort) {
    n2k::Frame frame;
    const Status status = n2k::compose_abort(waiting.command.issuer, waiting.command.number, route, frame);
    if (status == Status::kOk) frames.push_back(frame);
    return status;
  }
  if (setup_.mark) {
    const auto mark = challenge_ ? setup_.mark(waiting.command, *challenge_) : std::nullopt;
    if (!mark) return Status::kNotReady;
    waiting.command.mark = *mark;
  }
  n2k::FastPacketFrames packet;
  const Status status = n2k::compose_command(waiting.command, route, packet);
  if (status == Status::kOk) frames.insert(frames.end(), packet.begin(), packet.end());
  return status;
}

}  // namespace earshot::hil
