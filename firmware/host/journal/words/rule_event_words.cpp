#include "firmware/host/journal/words/rule_event_words.hpp"

#include <cstddef>

#include "firmware/config/safety.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::journal {
namespace {

constexpr int kMostDecimals = 6;

/// As fixed decimals of so many places; what does not fit is told apart by nothing.
bool reads_the_same(double a, double b, int places) {
  const std::string text = host::decimals(a, places);
  return text.size() < 32 && text == host::decimals(b, places);
}

}  // namespace

int decimals_apart(double measure, double limit) {
  int places = 1;
  if (measure == limit) return places;
  while (places < kMostDecimals && reads_the_same(measure, limit, places)) ++places;
  return places;
}

bool names_limit(const messages::SafetyEvent& event) {
  const config::ConditionTraits& traits = config::kConditionTraits.at(static_cast<std::size_t>(event.condition));
  return traits.kind != config::ConditionTraits::Kind::kFlag && (event.limit != 0.0 || !words_of_measure(event.condition));
}

std::optional<MeasureWords> words_of_measure(config::Condition condition) {
  switch (condition) {
    case config::Condition::kNavigationDisputed:
      return MeasureWords{.before = "late fixes lie ",
                          .behind = " m from those believed of their time",
                          .hint = "two senders give places (earshot journal --jsonl has the ports)"};
    case config::Condition::kPlaceUnexplained:
      return MeasureWords{.before = "the place went ",
                          .behind = " m further than speed, heading, current and their errors explain",
                          .hint = "check navigation, log and compass"};
    case config::Condition::kDepthUnexplained:
      return MeasureWords{.before = "the depth is ",
                          .behind = " m further from its set-points than it may be",
                          .hint = "check the depth sensor and whether the autopilot obeys"};
    case config::Condition::kSetpointsUnsent:
      return MeasureWords{.before = "no set-point could be sent for ", .behind = " s", .hint = "check the port's bus and its address"};
    default:
      return std::nullopt;
  }
}

std::string to_string(const messages::SafetyEvent& event) {
  using config::ConditionTraits;
  const auto condition = static_cast<std::size_t>(event.condition);
  const auto response = static_cast<std::size_t>(event.response);
  const std::string rule = "rule " + std::to_string(event.rule + 1) + ", ";
  if (condition >= config::kConditions || response >= config::kResponses) return rule + "which this program does not know";
  const ConditionTraits& traits = config::kConditionTraits.at(condition);
  std::string text = rule + std::string(traits.key);
  if (!event.begins) return text + ": no longer";
  const int places = decimals_apart(event.measure, event.limit);
  const std::optional<MeasureWords> words = words_of_measure(event.condition);
  const std::string measure = host::decimals(event.measure, places);
  if (traits.kind != ConditionTraits::Kind::kFlag)
    text += ": " + (words ? std::string(words->before) + measure + std::string(words->behind) : measure);
  if (names_limit(event))
    text += (traits.kind == ConditionTraits::Kind::kAbove ? ", above " : ", below ") + host::decimals(event.limit, places);
  text += ": " + std::string(config::kResponseWords.at(response));
  return words ? text + "; " + std::string(words->hint) : text;
}

}  // namespace earshot::journal
