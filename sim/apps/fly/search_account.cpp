#include "sim/apps/fly/search_account.hpp"

#include "firmware/config/safety.hpp"
#include "firmware/host/journal/words/rule_event_words.hpp"
#include "firmware/host/program/wrapped.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "sim/apps/fly/hearing/hear_option.hpp"
#include "sim/search/account/numbers.hpp"
#include "sim/search/account/search_account.hpp"

namespace earshot::fly {
namespace {

using host::decimals;

nlohmann::ordered_json or_null(const std::optional<std::uint32_t>& step) {
  return step ? nlohmann::ordered_json(*step) : nlohmann::ordered_json();
}

/// What a person should know of a flight that heard: its first minutes went by before the search.
std::string hearing_of(const nlohmann::json& hearing) {
  return std::string(hearing.at("sound") == kSynthetic ? "synthetic sound" : "recorded sound") + ": " +
         std::to_string(hearing.at("looks").get<std::uint64_t>()) + " SNRs measured, " +
         std::to_string(hearing.at("looks_too_faint").get<std::uint64_t>()) + " of them too faint; the first " +
         decimals(hearing.at("search_began_s"), 0) + " s at rest, to learn the noise of the sea";
}

}  // namespace

void SearchAccount::note(const link::Answer& answer, Meters range) {
  believes_ = believes_ || answer.believed_source.has_value();
  mismatch_bits_ = answer.mismatch_bits;
  if (answer.mismatch_bits >= messages::kMismatchThreshold_bits && !mismatch_step_) mismatch_step_ = answer.steps_taken;
  if (answer.is_sweeping && !sweep_step_) sweep_step_ = answer.steps_taken;
  const bool ends_for_good = answer.rule && answer.rule->response >= config::Response::kAbort;
  if (answer.rule && !ends_for_good && !home_by_) {
    home_by_ = answer.rule;
    home_step_ = answer.steps_taken;
  }
  if (answer.is_found && !declaration_) declaration_ = {.step = answer.steps_taken, .range = range};
}

nlohmann::ordered_json SearchAccount::to_json() const {
  nlohmann::ordered_json json{{"surprise_bits", nullptr},
                              {"surprised_from_step", or_null(mismatch_step_)},
                              {"swept_from_step", or_null(sweep_step_)},
                              {"declared_found", nullptr}};
  if (believes_) json["surprise_bits"] = mismatch_bits_;
  if (declaration_) json["declared_found"] = {{"step", declaration_->step}, {"range_m", declaration_->range.value}};
  if (home_by_) {
    json["went_home"] = {{"step", home_step_}};
    json["went_home"].update(ending_rule_to_json(home_by_));
  }
  return json;
}

nlohmann::ordered_json ending_rule_to_json(const std::optional<messages::SafetyEvent>& rule) {
  if (!rule) return nullptr;
  nlohmann::ordered_json json{{"what", journal::to_string(*rule)}, {"rule", rule->rule + 1}};
  if (!messages::is_known(rule->condition) || !messages::is_known(rule->response)) return json;
  json["condition"] = messages::key_of(rule->condition);
  json["value"] = rule->measure;
  json["limit"] = rule->limit;
  json["response"] = messages::key_of(rule->response);
  return json;
}

std::string entry(const std::string& label, const std::string& sentence) {
  constexpr std::size_t kIndent = 14;
  std::string text = "  " + label;
  text.resize(kIndent, ' ');
  return text + program::wrapped(sentence, kIndent, kIndent) + "\n";
}

std::string account_lines(const nlohmann::json& s) {
  std::string text;
  if (s.contains("battery_percent")) text += entry("battery", decimals(s.at("battery_percent"), 1) + " % left");
  for (const search::LabelledSentence& sentence : search::sentences(search::account_in(s))) text += entry(sentence.label, sentence.text);
  if (s.contains("hearing")) text += entry("heard", hearing_of(s.at("hearing")));
  return text;
}

}  // namespace earshot::fly
