#include "sim/apps/fly/search_account.hpp"

#include <array>
#include <cstdio>

#include "firmware/config/safety.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/rule_event_words.hpp"
#include "firmware/host/program/wrapped.hpp"
#include "firmware/messages/health.hpp"
#include "sim/apps/fly/hearing/hear_option.hpp"

namespace earshot::fly {
namespace {

nlohmann::ordered_json or_null(const std::optional<std::uint32_t>& step) {
  return step ? nlohmann::ordered_json(*step) : nlohmann::ordered_json();
}

std::string decimals(double value, int places) {
  std::array<char, 32> text{};
  (void)std::snprintf(text.data(), text.size(), "%.*f", places, value);
  return text.data();
}

std::string step_in(const nlohmann::json& summary, const char* key) {
  return "step " + std::to_string(summary.at(key).get<std::uint32_t>());
}

/// What a summary says under a key; null where it has none.
nlohmann::json value_in(const nlohmann::json& summary, const char* key) {
  return summary.value(key, nlohmann::json());
}

/// Whether the vehicle swept because it had heard nothing for long: nothing had surprised it by then.
bool swept_in_silence(const nlohmann::json& summary) {
  const nlohmann::json swept = value_in(summary, "swept_from_step");
  const nlohmann::json surprised = value_in(summary, "surprised_from_step");
  return !swept.is_null() && (surprised.is_null() || surprised.get<std::uint32_t>() > swept.get<std::uint32_t>());
}

/// A line of the console under its label.
std::string entry(const std::string& label, const std::string& sentence) {
  constexpr std::size_t kIndent = 14;
  std::string text = "  " + label;
  text.resize(kIndent, ' ');
  return text + program::wrapped(sentence, kIndent, kIndent) + "\n";
}

/// A number of bits says nothing without the one from which it is a surprise.
std::string surprise_of(const nlohmann::json& s) {
  const std::string end = decimals(s.at("surprise_bits"), 1) + " bits at the end, a surprise from " +
                          decimals(static_cast<double>(messages::kSurprising_bits), 2) + " on";
  const std::string what =
      value_in(s, "surprised_from_step").is_null()
          ? (swept_in_silence(s) ? "none by what it heard, but it heard less than its tables say"
                                 : "none: the oceans of its tables explain what it heard")
          : "from " + step_in(s, "surprised_from_step") + " on what it heard was unlikely in every ocean of its tables";
  return what + " (" + end + ")";
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
  surprise_bits_ = answer.surprise_bits;
  if (answer.surprise_bits >= messages::kSurprising_bits && !surprised_step_) surprised_step_ = answer.steps_taken;
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
                              {"surprised_from_step", or_null(surprised_step_)},
                              {"swept_from_step", or_null(sweep_step_)},
                              {"declared_found", nullptr}};
  if (believes_) json["surprise_bits"] = surprise_bits_;
  if (declaration_) json["declared_found"] = {{"step", declaration_->step}, {"range_m", declaration_->range.value}};
  if (home_by_) {
    json["went_home"] = {{"step", home_step_}};
    json["went_home"].update(ending_rule_to_json(home_by_));
  }
  return json;
}

nlohmann::ordered_json ending_rule_to_json(const std::optional<messages::SafetyEvent>& rule) {
  if (!rule) return nullptr;
  nlohmann::ordered_json json{{"what", host::to_string(*rule)}, {"rule", rule->rule + 1}};
  const auto condition = static_cast<std::size_t>(rule->condition);
  const auto response = static_cast<std::size_t>(rule->response);
  if (condition >= config::kConditions || response >= config::kResponses) return json;
  json["condition"] = config::kConditionTraits.at(condition).key;
  json["value"] = rule->measure;
  json["limit"] = rule->limit;
  json["response"] = config::kResponseWords.at(response);
  return json;
}

std::string outcome(const nlohmann::json& s) {
  if (s.at("found").get<bool>()) return "source found";
  const std::string reason = s.at("end_reason");
  if (reason == "earshotd_lost") return "the flight was lost: earshotd ended or did not answer";
  if (reason == "bus_lost") return "the flight was lost: a set-point did not arrive over the bus";
  if (reason == "nothing_heard") return "the flight was lost: the vehicle's detector gave no SNR";
  if (reason == "simulator_failed") return "the flight was lost: the simulator failed";
  if (reason == "steps_used_up") return "source not found: all " + std::to_string(s.at("steps").get<int>()) + " steps taken";
  if (const nlohmann::json declared = value_in(s, "declared_found"); reason == "declared_found" && !declared.is_null())
    return "declared found, wrongly: " + decimals(declared.at("range_m"), 0) + " m from the source";
  const nlohmann::json rule = value_in(s, "ended_by");
  if (rule.is_null()) return "source not found: " + host::spelled_apart(reason);
  const std::string what = "safety " + rule.at("what").get<std::string>();
  return "source not found: " + (reason == "safety_rule" ? what : host::spelled_apart(reason) + ": " + what);
}

std::string account_lines(const nlohmann::json& s) {
  std::string text;
  if (s.contains("battery_percent")) text += entry("battery", decimals(s.at("battery_percent"), 1) + " % left");
  if (!value_in(s, "surprise_bits").is_null()) text += entry("surprise", surprise_of(s));
  if (!value_in(s, "swept_from_step").is_null())
    text += entry("swept", "from " + step_in(s, "swept_from_step") + " of " + std::to_string(s.at("max_steps").get<int>()) +
                               (swept_in_silence(s) ? " on: it had heard nothing for long, where its tables say that it should"
                                                    : " on: what it heard fitted no ocean of its tables"));
  if (const nlohmann::json declared = value_in(s, "declared_found"); !declared.is_null()) {
    const double range_m = declared.at("range_m");
    const bool is_wrong = range_m > s.at("step_length_m").get<double>();
    text += entry("declared", "found at " + step_in(declared, "step") + (is_wrong ? ", wrongly: " : ": ") + decimals(range_m, 0) +
                                  " m from the source");
  } else if (s.at("found").get<bool>() && !value_in(s, "surprise_bits").is_null()) {
    text +=
        entry("declared", "not by the vehicle: the simulator ended the search within a step length of the source; at sea it would go on");
  }
  if (const nlohmann::json home = value_in(s, "went_home"); !home.is_null())
    text += entry("went home", "by " + home.at("what").get<std::string>() + ", after " +
                                   std::to_string(home.at("step").get<std::uint32_t>()) + (home.at("step") == 1 ? " step" : " steps"));
  if (s.contains("hearing")) text += entry("heard", hearing_of(s.at("hearing")));
  return text;
}

}  // namespace earshot::fly
