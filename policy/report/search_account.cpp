#include "policy/report/search_account.hpp"

#include <cmath>

#include "firmware/messages/health.hpp"
#include "policy/explain/wording.hpp"

namespace earshot::report {
namespace {

using explain::fixed;

constexpr std::uint64_t kMostSteps = 1'000'000'000;
constexpr double kMostNumber = 1e15;

/// What a summary says under a key; null where it has none.
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

}  // namespace

std::string fault_in_account(const nlohmann::json& summary) {
  for (const char* key : {"surprise_bits", "step_length_m"})
    if (const nlohmann::json value = value_in(summary, key); !value.is_null() && !is_number(value))
      return std::string(key) + ": must be a number";
  for (const char* key : {"surprised_from_step", "swept_from_step", "max_steps"})
    if (const nlohmann::json value = value_in(summary, key); !value.is_null() && !is_step(value))
      return std::string(key) + ": must be a whole number, 0 to 1000000000";
  const nlohmann::json declared = value_in(summary, "declared_found");
  const bool is_declaration = declared.is_object() && is_step(value_in(declared, "step")) && is_number(value_in(declared, "range_m"));
  return declared.is_null() || is_declaration ? "" : "declared_found: must be step, range_m";
}

SearchAccount account_in(const nlohmann::json& summary) {
  const nlohmann::json surprise = value_in(summary, "surprise_bits");
  SearchAccount account{.believes = !surprise.is_null(),
                        .surprise_bits = surprise.is_null() ? 0.0 : surprise.get<double>(),
                        .surprised_step = known<std::uint32_t>(value_in(summary, "surprised_from_step")),
                        .sweep_step = known<std::uint32_t>(value_in(summary, "swept_from_step")),
                        .max_steps = known<std::uint32_t>(value_in(summary, "max_steps")),
                        .step_length_m = known<double>(value_in(summary, "step_length_m"))};
  if (const nlohmann::json declared = value_in(summary, "declared_found"); !declared.is_null()) {
    account.declared_step = declared.at("step").get<std::uint32_t>();
    account.declared_range_m = declared.at("range_m").get<double>();
  }
  account.is_found_undeclared = account.believes && !account.declared_step && value_in(summary, "found") == true;
  return account;
}

std::string declared_where(const SearchAccount& account) {
  if (!account.declared_range_m) return "";
  const bool is_wrong = account.step_length_m && *account.declared_range_m > *account.step_length_m;
  return (is_wrong ? ", wrongly: " : ": ") + fixed(*account.declared_range_m, 0) + " m from the source";
}

namespace {

/// A number of bits says nothing without the one from which it is a surprise.
std::string surprise_to_string(const SearchAccount& account) {
  const std::string level = fixed(static_cast<double>(messages::kSurprising_bits), 2);
  const std::string bits = "surprise " + fixed(account.surprise_bits, 1) + " bits at the end, ";
  if (account.surprised_step)
    return "From " + step_to_string(*account.surprised_step) + " on what it heard was unlikely in every ocean of its tables (" + bits +
           "which counts from " + level + " on)";
  if (account.swept_in_silence())
    return "Its tables explain what it heard, but not that it was so little (" + bits + "which would count from " + level + " on)";
  return "Nothing unexpected: the oceans of its tables explain what it heard (" + bits + "which would count from " + level + " on)";
}

}  // namespace

std::string to_string(const SearchAccount& account) {
  std::string text;
  const auto say = [&text](const std::string& sentence) { text += (text.empty() ? "" : " ") + sentence + "."; };
  if (account.believes) say(surprise_to_string(account));
  if (account.sweep_step)
    say("Swept from " + step_to_string(*account.sweep_step) + (account.max_steps ? " of " + std::to_string(*account.max_steps) : "") +
        (account.swept_in_silence() ? " on: it had heard nothing for long, where its tables say that it should"
                                    : " on: what it heard fitted no ocean of its tables"));
  if (account.declared_step) say("Declared found at " + step_to_string(*account.declared_step) + declared_where(account));
  if (account.is_found_undeclared)
    say("Not declared found by the vehicle: the simulator ended the search within a step length of the source; at sea it would go on");
  return text;
}

}  // namespace earshot::report
