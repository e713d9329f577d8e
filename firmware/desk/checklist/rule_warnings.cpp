#include "firmware/desk/checklist/rule_warnings.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <span>

#include "firmware/desk/checklist/budgets.hpp"
#include "firmware/host/mission/rule_words.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::board {
namespace {

using config::Condition;
using config::Rule;

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

constexpr std::array kReportedByVehicle{Condition::kAltitude, Condition::kBattery, Condition::kBatteryAtHome, Condition::kLeak,
                                        Condition::kGroundFault};
constexpr std::array kReportedByAutopilot{Condition::kAutopilotDisengaged};

/// Whose word some rules go by, and the condition that would notice his silence.
struct Witness {
  const char* name;
  Condition silence;
  std::span<const Condition> conditions;
};
// Nothing tells the age of what a hydrophone says of itself; one that is silent altogether is noticed by snr_age_s, which stands in every
// mission.
constexpr std::array<Witness, 2> kWitnesses{{
    {"the vehicle's status", Condition::kVehicleStatusAge, kReportedByVehicle},
    {"the autopilot's status", Condition::kAutopilotAge, kReportedByAutopilot},
}};

/// Its place in the list of the checklist.
std::size_t number_of(const config::Mission& mission, std::size_t own) {
  return safety::standing_rules(mission) + own + 1;
}

/// In words, with its key.
std::string name_of(Condition condition) {
  const config::ConditionTraits& traits = config::kConditionTraits.at(static_cast<std::size_t>(condition));
  return std::string(traits.meaning) + " (" + std::string(traits.key) + ")";
}

/// Why a battery is at the rule's limit before all steps are taken; empty: it is not.
std::string drain(const config::Mission& mission, const Rule& rule) {
  const double steps = percent_for_all_steps(mission);
  const bool counts_way_home = rule.condition == Condition::kBatteryAtHome && mission.safety.safe_point;
  const double home = counts_way_home ? percent_for_way_home(mission) : 0.0;
  if (steps + home + rule.limit <= 100.0) return {};
  std::string text = host::formatted("all steps need %.0f %% of a battery", steps);
  if (counts_way_home) text += host::formatted(", the longest way home %.0f %%", home);
  return text + host::formatted(", and the rule keeps %g %%", rule.limit);
}

/// Of a vehicle at the surface whose search is told to be deep, or of one that points away from its first leg.
std::string slow_to_obey(const config::Mission& mission, const Rule& rule) {
  const config::VehicleLimits& vehicle = mission.safety.vehicle;
  if (rule.condition == Condition::kDepthIgnored) {
    const double dive_s = (mission.search_depth.value - rule.limit) / vehicle.max_speed.value;
    if (rule.persistence.to_seconds() >= dive_s) return {};
    return host::formatted("from the surface to %g m the vehicle takes %.0f s at least", mission.search_depth.value, dive_s);
  }
  const double turn_s = (180.0 - rule.limit) / kDegreesPerRadian * vehicle.turn_radius.value / mission.search_speed.value;
  if (rule.persistence.to_seconds() >= turn_s) return {};
  return host::formatted("to turn round the vehicle takes up to %.0f s", turn_s);
}

/// Why a rule acts in a search that goes as it is planned; empty: it need not.
std::string why_it_acts(const config::Mission& mission, const Rule& rule) {
  switch (rule.condition) {
    case Condition::kDepth:
      if (rule.limit >= (mission.search_depth + kDepthRoom).value) return {};
      return host::formatted("the search is at %g m; leave %g m", mission.search_depth.value, kDepthRoom.value);
    case Condition::kSpeed:
      return rule.limit > mission.search_speed.value ? std::string()
                                                     : host::formatted("the search is at %g m/s", mission.search_speed.value);
    case Condition::kTurnRate: {
      const Meters radius = mission.safety.vehicle.turn_radius;
      const double rate = radius > Meters{} ? mission.search_speed.value / radius.value * kDegreesPerRadian : 0.0;
      return rule.limit >= rate ? std::string() : host::formatted("the vehicle's tightest turn is %.1f degrees a second", rate);
    }
    case Condition::kSearchTime:
      if (rule.limit >= seconds_for_all_steps(mission)) return {};
      return host::formatted("all steps take %.0f s in still water", seconds_for_all_steps(mission));
    case Condition::kDistanceTravelled:
      if (rule.limit >= way_of_all_steps(mission).value) return {};
      return host::formatted("all steps are %.0f m", way_of_all_steps(mission).value);
    case Condition::kBattery:
    case Condition::kBatteryAtHome:
      return drain(mission, rule);
    case Condition::kHeadingIgnored:
    case Condition::kDepthIgnored:
      return slow_to_obey(mission, rule);
    default:
      return {};
  }
}

bool is_watched(const config::Mission& mission, Condition silence) {
  return std::ranges::any_of(mission.safety.rules, [silence](const Rule& rule) { return rule.condition == silence; });
}

/// "rule 11", "rules 11, 12, 13"; empty: none goes by his word.
std::string rules_by(const config::Mission& mission, const Witness& witness) {
  std::string numbers;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mission.safety.rules.size(); ++i) {
    if (std::ranges::find(witness.conditions, mission.safety.rules[i].condition) == witness.conditions.end()) continue;
    numbers += (count++ == 0 ? " " : ", ") + std::to_string(number_of(mission, i));
  }
  if (count == 0) return {};
  return (count == 1 ? "rule" : "rules") + numbers;
}

}  // namespace

std::vector<std::string> rule_warnings(const config::Mission& mission) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < mission.safety.rules.size(); ++i) {
    const Rule& rule = mission.safety.rules[i];
    const std::string why = why_it_acts(mission, rule);
    if (!why.empty())
      warnings.push_back("rule " + std::to_string(number_of(mission, i)) + " (" + host::sentence_of(rule) +
                         ") acts in a search that goes as it is planned: " + why);
  }
  for (const Witness& witness : kWitnesses) {
    const std::string rules = rules_by(mission, witness);
    if (!rules.empty() && !is_watched(mission, witness.silence))
      warnings.push_back("no rule watches " + name_of(witness.silence) + ": when nobody reports " + witness.name + " (any more), " + rules +
                         " must go by the last word, or by none");
  }
  return warnings;
}

}  // namespace earshot::board
