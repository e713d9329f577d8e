#include "firmware/host/journal/words/rule_event_words.hpp"

#include <cstddef>
#include <string_view>

#include "firmware/config/safety.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"

namespace earshot::journal {
namespace {

constexpr int kMostDecimals = 6;

/// As fixed decimals of so many places; what does not fit is told apart by nothing.
bool reads_the_same(double a, double b, int places) {
  host::TextLine first;
  host::TextLine second;
  first.decimal(a, places);
  second.decimal(b, places);
  return first.text() == second.text() && first.text() != "?";
}

/// What a measure says, where a number beside its limit says too little: what stands before and behind it, and where to look.
struct MeasureWords {
  std::string_view before;
  std::string_view behind;
  std::string_view hint;
};

/// Empty: "310.0, above 300.0" says it.
MeasureWords words_of_measure(config::Condition condition) {
  switch (condition) {
    case config::Condition::kNavigationDisputed:
      return {.before = "late fixes lie ",
              .behind = " m from those believed of their time",
              .hint = "two senders give places (earshot journal --jsonl has the ports)"};
    case config::Condition::kPlaceUnexplained:
      return {.before = "the place went ",
              .behind = " m further than speed, heading, current and their errors explain",
              .hint = "check navigation, log and compass"};
    case config::Condition::kDepthUnexplained:
      return {.before = "the depth is ",
              .behind = " m further from its set-points than it may be",
              .hint = "check the depth sensor and whether the autopilot obeys"};
    case config::Condition::kSetpointsUnsent:
      return {.before = "no set-point could be sent for ", .behind = " s", .hint = "check the port's bus and its address"};
    default:
      return {};
  }
}

}  // namespace

int decimals_apart(double measure, double limit) {
  int places = 1;
  if (measure == limit) return places;
  while (places < kMostDecimals && reads_the_same(measure, limit, places)) ++places;
  return places;
}

void write_rule(host::TextInto& line, const messages::SafetyEvent& event) {
  using config::ConditionTraits;
  line << "rule " << event.rule + 1 << ", ";
  if (!messages::is_known(event.condition) || !messages::is_known(event.response)) {
    line << "which this program does not know";
    return;
  }
  const ConditionTraits& traits = config::kConditionTraits.at(static_cast<std::size_t>(event.condition));
  line << traits.key;
  if (!event.begins) {
    line << ": no longer";
    return;
  }
  const MeasureWords words = words_of_measure(event.condition);
  const int places = decimals_apart(event.measure, event.limit);
  if (traits.kind != ConditionTraits::Kind::kFlag) {
    line << ": " << words.before;
    line.decimal(event.measure, places) << words.behind;
    // "further than" has said it where the limit is zero.
    if (event.limit != 0.0 || words.before.empty()) {
      line << (traits.kind == ConditionTraits::Kind::kAbove ? ", above " : ", below ");
      line.decimal(event.limit, places);
    }
  }
  line << ": " << messages::key_of(event.response);
  if (!words.hint.empty()) line << "; " << words.hint;
}

std::string to_string(const messages::SafetyEvent& event) {
  host::TextLine line;
  write_rule(line, event);
  return std::string(line.text());
}

}  // namespace earshot::journal
