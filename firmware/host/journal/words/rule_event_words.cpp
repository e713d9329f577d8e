#include "firmware/host/journal/words/rule_event_words.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <system_error>

#include "firmware/config/safety.hpp"

namespace earshot::journal {
namespace {

constexpr int kMostDecimals = 6;

std::string decimal(double number, int places) {
  std::array<char, 400> digits{};  // 1.8e308 written out has 309
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, places);
  return error == std::errc{} ? std::string(digits.data(), end) : "?";
}

/// As fixed decimals of so many places; what does not fit is told apart by nothing.
bool reads_the_same(double a, double b, int places) {
  std::array<char, 32> of_a{};
  std::array<char, 32> of_b{};
  const auto end_of_a = std::to_chars(of_a.data(), of_a.data() + of_a.size(), a, std::chars_format::fixed, places);
  const auto end_of_b = std::to_chars(of_b.data(), of_b.data() + of_b.size(), b, std::chars_format::fixed, places);
  return end_of_a.ec == std::errc{} && end_of_b.ec == std::errc{} && of_a == of_b;
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
                          .look_at = "two senders give places (earshot journal --jsonl has the ports)"};
    case config::Condition::kPlaceUnexplained:
      return MeasureWords{.before = "the place went ",
                          .behind = " m further than speed, heading, current and their errors explain",
                          .look_at = "check navigation, log and compass"};
    case config::Condition::kDepthUnexplained:
      return MeasureWords{.before = "the depth is ",
                          .behind = " m further from its set-points than it may be",
                          .look_at = "check the depth sensor and whether the autopilot obeys"};
    case config::Condition::kSetpointsUnsent:
      return MeasureWords{.before = "no set-point could be sent for ", .behind = " s", .look_at = "check the port's bus and its address"};
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
  const std::string measure = decimal(event.measure, places);
  if (traits.kind != ConditionTraits::Kind::kFlag)
    text += ": " + (words ? std::string(words->before) + measure + std::string(words->behind) : measure);
  if (names_limit(event)) text += (traits.kind == ConditionTraits::Kind::kAbove ? ", above " : ", below ") + decimal(event.limit, places);
  text += ": " + std::string(config::kResponseWords.at(response));
  return words ? text + "; " + std::string(words->look_at) : text;
}

}  // namespace earshot::journal
