#include "sim/search/account/search_account.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "firmware/config/safety.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "firmware/messages/health.hpp"
#include "sim/search/account/numbers.hpp"

namespace earshot::search {
namespace {

using messages::EndReason;

constexpr std::uint64_t kMostSteps = 1'000'000'000;
constexpr double kMostNumber = 1e15;
constexpr std::string_view kSurfaceKey = messages::key_of(config::Response::kSurface);

/// The value of a summary's key; null where it has none.
nlohmann::json value_in(const nlohmann::json& table, const char* key) {
  return table.value(key, nlohmann::json());
}

bool is_number(const nlohmann::json& value) {
  return value.is_number() && std::abs(value.get<double>()) <= kMostNumber;
}

bool is_step(const nlohmann::json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= kMostSteps;
}

template <class Value>
std::optional<Value> known(const nlohmann::json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<Value>());
}

std::string step_to_string(std::uint32_t step) {
  return "step " + std::to_string(step);
}

std::string meters_to_string(double length_m) {
  return host::decimals(length_m, 0) + " m";
}

std::string step_length_to_string(std::optional<double> length_m) {
  return length_m ? host::decimals(*length_m / 1e3, 1) + " km" : "one step length";
}

/// An earlier version's summary calls the source that was reached "found", and a declaration "declared_found".
std::string end_reason_in(const nlohmann::json& summary) {
  std::string reason = summary.value("end_reason", std::string());
  if (reason == "declared_found") return std::string(messages::key_of(EndReason::kFound));
  const bool is_reached = value_in(summary, "found") == true && reason == messages::key_of(EndReason::kFound);
  return is_reached ? std::string(messages::key_of(EndReason::kCompleted)) : reason;
}

bool is_end(const SearchAccount& account, EndReason reason) {
  return account.end_reason == messages::key_of(reason);
}

/// A simulation that could not go on; "": it was none.
std::string loss_to_string(const std::string& reason) {
  constexpr std::array<std::pair<const char*, const char*>, 4> kLosses{{{"earshotd_lost", "earshotd ended or did not answer"},
                                                                        {"bus_lost", "a set-point did not arrive over the bus"},
                                                                        {"nothing_heard", "the vehicle's detector gave no SNR"},
                                                                        {"simulator_failed", "the simulator failed"}}};
  for (const auto& [code, words] : kLosses)
    if (reason == code) return words;
  return "";
}

std::string mismatch_sentence(const SearchAccount& a) {
  const std::string score = " (model-mismatch score " + host::decimals(a.mismatch_bits, 1) + " bits at the end; from " +
                            host::decimals(static_cast<double>(messages::kMismatchThreshold_bits), 2) + " on it is a mismatch).";
  if (a.mismatch_step)
    return "From " + step_to_string(*a.mismatch_step) + " on, the SNR that it measured was unlikely in every ocean of its tables" + score;
  if (a.swept_in_silence())
    return "The SNR that it measured fits the oceans of its tables, but there were too few detections: the source may be fainter or silent "
           "for longer than expected, or not there" +
           score;
  return "The SNR that it measured fits the oceans of its tables" + score;
}

std::string sweep_sentence(const SearchAccount& a) {
  return "From " + step_to_string(*a.sweep_step) + (a.max_steps ? " of " + std::to_string(*a.max_steps) : "") +
         " on it swept the whole area in parallel tracks: " +
         (a.swept_in_silence() ? "it had detected nothing for long, where its tables predict detections."
                               : "the SNR that it measured fits no ocean of its tables.");
}

std::string declared_sentence(const SearchAccount& a) {
  const std::string what = "The vehicle declared the source found at " + step_to_string(*a.declared_step);
  if (!a.declared_range_m) return what + ".";
  return what + (a.declared_wrongly() ? ", wrongly: " : ": ") + meters_to_string(*a.declared_range_m) + " from the source.";
}

std::string way_home_sentence(const SearchAccount::WayHome& way_home) {
  return "After " + host::counted(way_home.steps, "step") + " a safety rule sent the vehicle " +
         (way_home.is_to_surface ? "to the surface" : "home") + ": " + way_home.rule + ".";
}

}  // namespace

std::string fault_in_account(const nlohmann::json& summary) {
  for (const char* key : {"surprise_bits", "step_length_m"})
    if (const nlohmann::json value = value_in(summary, key); !value.is_null() && !is_number(value))
      return std::string(key) + ": must be a number";
  for (const char* key : {"surprised_from_step", "swept_from_step", "max_steps"})
    if (const nlohmann::json value = value_in(summary, key); !value.is_null() && !is_step(value))
      return std::string(key) + ": must be a whole number, 0 to 1000000000";
  const nlohmann::json rule = value_in(summary, "ended_by");
  if (!rule.is_null() && !(rule.is_object() && value_in(rule, "what").is_string())) return "ended_by: must be what, rule";
  const nlohmann::json declared = value_in(summary, "declared_found");
  const bool is_declaration = declared.is_object() && is_step(value_in(declared, "step")) && is_number(value_in(declared, "range_m"));
  if (!declared.is_null() && !is_declaration) return "declared_found: must be step, range_m";
  const nlohmann::json home = value_in(summary, "went_home");
  const bool is_way_home = home.is_object() && is_step(value_in(home, "step")) && value_in(home, "what").is_string();
  return home.is_null() || is_way_home ? "" : "went_home: must be step, what";
}

SearchAccount account_in(const nlohmann::json& summary) {
  const nlohmann::json mismatch = value_in(summary, "surprise_bits");
  SearchAccount account{.believes = !mismatch.is_null(),
                        .mismatch_bits = mismatch.is_null() ? 0.0 : mismatch.get<double>(),
                        .mismatch_step = known<std::uint32_t>(value_in(summary, "surprised_from_step")),
                        .sweep_step = known<std::uint32_t>(value_in(summary, "swept_from_step")),
                        .max_steps = known<std::uint32_t>(value_in(summary, "max_steps")),
                        .step_length_m = known<double>(value_in(summary, "step_length_m")),
                        .is_found = value_in(summary, "found") == true,
                        .steps = summary.value("steps", std::uint32_t{0}),
                        .end_reason = end_reason_in(summary)};
  if (const nlohmann::json declared = value_in(summary, "declared_found"); !declared.is_null()) {
    account.declared_step = declared.at("step").get<std::uint32_t>();
    account.declared_range_m = declared.at("range_m").get<double>();
  }
  if (const nlohmann::json home = value_in(summary, "went_home"); !home.is_null())
    account.way_home = {.rule = home.at("what").get<std::string>(),
                        .steps = home.at("step").get<std::uint32_t>(),
                        .is_to_surface = value_in(home, "response") == kSurfaceKey};
  if (const nlohmann::json rule = value_in(summary, "ended_by"); !rule.is_null()) account.ending_rule = rule.at("what").get<std::string>();
  return account;
}

std::string end_to_string(const SearchAccount& a) {
  if (is_end(a, EndReason::kCompleted)) return "the vehicle came within " + step_length_to_string(a.step_length_m) + " of the source";
  if (is_end(a, EndReason::kStepsUsedUp)) return "all " + host::counted(a.steps, "step") + " were taken";
  if (is_end(a, EndReason::kFound)) return messages::to_string(EndReason::kFound);
  if (const std::string loss = loss_to_string(a.end_reason); !loss.empty()) return loss;
  const std::string reason = host::spelled_apart(a.end_reason);
  if (a.ending_rule.empty()) return reason;
  return is_end(a, EndReason::kSafetyRule) ? "safety " + a.ending_rule : reason + ": safety " + a.ending_rule;
}

Verdict verdict_on(const SearchAccount& a) {
  if (a.is_found)
    return {true, "Source found after " + host::counted(a.steps, "step") + ": the vehicle came within " +
                      step_length_to_string(a.step_length_m) + " of it"};
  if (!loss_to_string(a.end_reason).empty())
    return {false, "The flight was lost after " + host::counted(a.steps, "step") + ": " + end_to_string(a)};
  const std::string declared = a.declared_range_m
                                   ? "at " + step_to_string(*a.declared_step) + (a.declared_wrongly() ? ", wrongly, " : ", ") +
                                         meters_to_string(*a.declared_range_m) + " from it"
                                   : "";
  if (!declared.empty() && !a.declared_wrongly()) return {true, "Source found: the vehicle declared it found " + declared};
  const std::string missed = "Source not found in " + host::counted(a.steps, "step") + ": ";
  return {false, missed + (declared.empty() ? end_to_string(a) : "the vehicle declared it found " + declared)};
}

std::vector<LabelledSentence> sentences(const SearchAccount& a) {
  std::vector<LabelledSentence> all;
  if (a.believes) all.push_back({"mismatch", mismatch_sentence(a)});
  if (a.sweep_step) all.push_back({"sweep", sweep_sentence(a)});
  if (a.declared_step)
    all.push_back({"declared", declared_sentence(a)});
  else if (a.believes && a.is_found)
    all.push_back(
        {"declared",
         "The vehicle's own rule had not reported the source found by then. The simulation ends here; at sea the search would go on."});
  if (a.way_home) all.push_back({a.way_home->is_to_surface ? "came up" : "went home", way_home_sentence(*a.way_home)});
  return all;
}

std::string to_string(const SearchAccount& account) {
  std::string text;
  for (const LabelledSentence& sentence : sentences(account)) text += (text.empty() ? "" : " ") + sentence.text;
  return text;
}

std::string place_of_area(const nlohmann::json& summary, const std::string& degree) {
  const nlohmann::json origin = value_in(summary, "origin");
  if (origin.is_null()) return "";
  const nlohmann::json& corner = summary.at("area").at("south_west");
  const bool is_corner = corner.at("north_m") == 0.0 && corner.at("east_m") == 0.0;
  return (is_corner ? "its south-west corner lies at " : "the place from which metres north and east count lies at ") +
         geographic(origin.at("latitude_deg"), origin.at("longitude_deg"), degree);
}

std::string detection_means(double threshold_db) {
  return "a step that ends with an SNR of " + host::decimals(threshold_db, 0) + " dB or more";
}

std::string found_means(std::optional<double> step_length_m) {
  return "the vehicle came within one step length of the source" + (step_length_m ? ", " + step_length_to_string(step_length_m) : "");
}

}  // namespace earshot::search
