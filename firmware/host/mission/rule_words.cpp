#include "firmware/host/mission/rule_words.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace earshot::host {
namespace {

using config::ConditionTraits;

const ConditionTraits& traits_of(const config::Rule& rule) {
  return config::kConditionTraits.at(static_cast<std::size_t>(rule.condition));
}

const config::ResponseTraits& response_of(const config::Rule& rule) {
  return config::kResponseTraits.at(static_cast<std::size_t>(rule.response));
}

std::string lasting(const config::Rule& rule) {
  return rule.persistence > Duration{} ? " for " + shortly(rule.persistence.to_seconds()) + " s" : "";
}

/// The unit that a key ends with, with a blank before it.
std::string_view unit_of(std::string_view key) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kUnits{
      {{"_deg_per_s", " degrees a second"}, {"_percent", " %"}, {"_mps", " m/s"}, {"_deg", " degrees"}, {"_s", " s"}, {"_m", " m"}}};
  for (const auto& [end, unit] : kUnits) {
    if (key.ends_with(end)) return unit;
  }
  return {};
}

/// "the age of the newest fix is above 5 s"
std::string clause_of(const config::Rule& rule) {
  const ConditionTraits& traits = traits_of(rule);
  if (traits.kind == ConditionTraits::Kind::kFlag) return std::string(traits.meaning);
  const std::string limit = shortly(rule.limit) + std::string(unit_of(traits.key));
  if (rule.condition == config::Condition::kPlaceUnexplained)
    return "the place went further than speed, heading and current explain, by more than " + limit;
  if (rule.condition == config::Condition::kNavigationDisputed)
    return "late fixes lie more than " + limit + " from those believed of the same moment";
  return std::string(traits.meaning) + (traits.kind == ConditionTraits::Kind::kAbove ? " is above " : " is below ") + limit;
}

}  // namespace

std::string shortly(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string to_string(const config::Rule& rule) {
  const ConditionTraits& traits = traits_of(rule);
  std::string text(traits.key);
  if (traits.kind == ConditionTraits::Kind::kAbove) text += " above " + shortly(rule.limit);
  if (traits.kind == ConditionTraits::Kind::kBelow) text += " below " + shortly(rule.limit);
  return text + lasting(rule) + " then " + std::string(response_of(rule).key);
}

std::string sentence_of(const config::Rule& rule) {
  const std::string text =
      std::string(response_of(rule).deed) + " once " + clause_of(rule) + lasting(rule) + " (" + std::string(traits_of(rule).key) + ")";
  const bool ends_the_mission = rule.response >= config::Response::kAbort;
  return rule.is_latched && !ends_the_mission ? text + ", and until the mission ends" : text;
}

}  // namespace earshot::host
