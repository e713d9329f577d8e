#include "firmware/authority/command_judge.hpp"

#include <algorithm>
#include <cstdint>

#include "firmware/messages/dictionary/command_words.hpp"

namespace earshot::authority {
namespace {

using messages::CommandOutcome;
using messages::Order;

constexpr Duration kMaxAge{config::kCommandMaxAge_us};

/// As serial numbers do (RFC 1982): after 2^32 - 1 comes 0, and half of all numbers are ahead of any. Whatever number an issuer has used,
/// or somebody in its name, leaves it two thousand million to go on with.
bool is_ahead(std::uint32_t number, std::uint32_t last) {
  return static_cast<std::int32_t>(number - last) > 0;
}

CommandOutcome judge_date(Time arrival, const messages::OperatorCommand& command) {
  if (!lies_within(command.time, arrival, kMaxAge)) return CommandOutcome::kTooOld;
  return arrival > command.expiry ? CommandOutcome::kExpired : CommandOutcome::kObeyed;
}

}  // namespace

CommandJudge::Verdict CommandJudge::judge(Time arrival, const messages::OperatorCommand& command, Sender sender) {
  if (!is_known(command.order)) return {.outcome = CommandOutcome::kUnknownOrder};
  if (command.order == Order::kAbort) return {};
  if (needs_verified_ && !command.is_verified)
    return {.outcome = command.has_old_mark ? CommandOutcome::kOldMark : CommandOutcome::kNotVerified};
  const CommandOutcome by_date = judge_date(arrival, command);
  if (sender == Sender::kVehicle) return {.outcome = by_date};
  const bool is_from_now = by_date == CommandOutcome::kObeyed;
  const auto known = std::find_if(issuers_.begin(), issuers_.end(), [&](const Issuer& i) { return i.issuer == command.issuer; });
  if (known == issuers_.end()) return {.outcome = by_date, .is_from_now = is_from_now};
  known->last_heard = ++heard_;
  if (command.number == known->last_number) return {.outcome = known->last_outcome, .is_repetition = true, .is_from_now = is_from_now};
  if (!is_ahead(command.number, known->last_number)) return {.outcome = CommandOutcome::kOutOfOrder};
  return {.outcome = by_date, .is_from_now = is_from_now};
}

void CommandJudge::remember(const messages::OperatorCommand& command, CommandOutcome outcome) {
  auto place = std::find_if(issuers_.begin(), issuers_.end(), [&](const Issuer& i) { return i.issuer == command.issuer; });
  if (place == issuers_.end()) {
    static_cast<void>(issuers_.push_back({}));
    place =
        std::min_element(issuers_.begin(), issuers_.end(), [](const Issuer& a, const Issuer& b) { return a.last_heard < b.last_heard; });
  }
  *place = {.issuer = command.issuer, .last_number = command.number, .last_outcome = outcome, .last_heard = ++heard_};
}

}  // namespace earshot::authority
