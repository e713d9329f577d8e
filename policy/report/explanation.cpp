#include "policy/report/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>

#include "firmware/core/math.hpp"

namespace earshot::report {
namespace {

using explain::DecisionAccount;
using explain::factor_to_string;
using explain::fixed;

std::string percent(double share) {
  const double p = 100.0 * share;
  return (p > 0.0 && p < 0.1 ? std::string("under 0.1") : fixed(p, p < 10.0 ? 1 : 0)) + " %";
}

std::string km(Meters length) {
  return fixed(length.value / 1e3, 1) + " km";
}

std::string square_km(double area) {
  return fixed(area, area < 10.0 ? 1 : 0) + " km\u00B2";
}

std::string place_to_string(NorthEast place) {
  return fixed(place.north.value / 1e3, 2) + " km north, " + fixed(place.east.value / 1e3, 2) + " km east";
}

/// Clockwise from north.
Radians bearing_between(NorthEast from, NorthEast to) {
  const NorthEast way = to - from;
  return bearing_of(way.north.value, way.east.value);
}

/// "3.2 km NE"
std::string likeliest_place(const DecisionAccount& a) {
  const NorthEast likeliest = a.area.south_west + a.place.likeliest;
  return km(range_between(a.decision.position, likeliest)) + " " + explain::compass_point(bearing_between(a.decision.position, likeliest));
}

std::string measured_sentence(const DecisionAccount& a) {
  const std::string unused = a.uses_measurements ? "" : " This policy does not use it: it goes by the vehicle's place and steps alone.";
  if (a.decision.too_faint)
    return "The signal was too faint to measure: the SNR is below " + fixed(a.decision.snr.value, 1) + " dB." + unused;
  const std::string threshold = fixed(a.detection_threshold.value, 0) + " dB";
  return (a.uses_measurements ? "It measured an SNR of " : "The SNR here was ") + to_string(a.decision.reception()) + ", " +
         (a.decision.detected ? "a detection (threshold " + threshold + ")." : "below the threshold of " + threshold + ": no detection.") +
         unused;
}

std::string belief_sentence(const DecisionAccount& a) {
  const Radians bearing = bearing_between(a.decision.position, a.area.south_west + a.place.likeliest);
  return std::string(a.belief_is_the_policys ? "It believes" : "An observer would believe (this policy holds no belief)") +
         " that the source is most likely " + likeliest_place(a) + " (bearing " + explain::degrees_to_string(bearing) +
         ", the likeliest single place of a belief that is spread); with 50 % it lies within " + square_km(a.place.smallest_area_km2(0.5)) +
         ", with 95 % within " + square_km(a.place.smallest_area_km2(0.95)) + ".";
}

std::string declared_sentence(const DecisionAccount& a) {
  return "It declared the source found: with " + percent(static_cast<double>(a.decision.found->probability)) +
         " the source lies within a step of here.";
}

std::string sweep_sentence(const DecisionAccount& a) {
  const std::string sweep =
      "It sweeps the whole area in parallel tracks, not by the policy, and went " + a.actions[a.decision.action].name + ": ";
  if (!a.decision.was_mismatched) return sweep + "it had detected nothing for long, where its tables predict detections.";
  return sweep + "the SNR that it measured fits no ocean of its tables (model-mismatch score " +
         fixed(static_cast<double>(a.decision.mismatch_bits()), 1) + " bits).";
}

std::string expectation_sentence(const DecisionAccount& a) {
  const explain::ActionAccount& taken = a.actions[a.decision.action];
  return "At the end of this step " + std::string(a.belief_is_the_policys ? "it expects" : "an observer would expect") + " an SNR of " +
         fixed(taken.hear.snr.value, 1) + " dB, give or take " + fixed(taken.hear.spread.value, 1) + " dB: a detection with " +
         percent(taken.detected) + ", the source found with " + percent(taken.found) + ".";
}

std::string safety_sentence(const DecisionAccount& a) {
  if (!a.decision.overridden) return "The safety layer left the way-point as it was.";
  const NorthEast wanted = a.actions[a.decision.action].end;
  return "The safety layer moved the way-point by " + fixed(range_between(wanted, a.decision.waypoint).value, 0) + " m, to " +
         place_to_string(a.decision.waypoint) + ".";
}

/// What one of two directions promises more than the other, in physical words, and by how much: a probability, or a part of a step.
struct Reason {
  std::string text;
  double advantage = 0.0;  ///< of the direction taken
};

/// "0.90 km nearer", "0.11 km further off"
std::string approach_to_string(Meters approach) {
  return fixed(std::abs(approach.value) / 1e3, 2) + (approach.value < 0.0 ? " km further off" : " km nearer");
}

/// Those in which the two differ as they are printed. The strongest for the direction taken is first, the strongest for the other last.
std::vector<Reason> reasons_for(const explain::ActionAccount& taken, const explain::ActionAccount& next, Meters step_length) {
  std::vector<Reason> reasons;
  const auto add = [&](const std::string& text, const std::string& of_taken, const std::string& of_next, double advantage) {
    if (of_taken == of_next) return;
    reasons.push_back(
        {text + (advantage < 0.0 ? of_next + " (" + taken.name + " " + of_taken + ")" : of_taken + " (" + next.name + " " + of_next + ")"),
         advantage});
  };
  add("it finds the source within three steps with ", percent(taken.found_soon), percent(next.found_soon),
      taken.found_soon - next.found_soon);
  add("it ends ", approach_to_string(taken.approach), approach_to_string(next.approach), (taken.approach - next.approach) / step_length);
  add("it detects the source with ", percent(taken.detected), percent(next.detected), taken.detected - next.detected);
  std::ranges::stable_sort(reasons, std::ranges::greater{}, &Reason::advantage);
  return reasons;
}

/// " For NE: it detects the source with 80 % (E 75 %)." @param reasons  empty: nothing
std::string listed(const std::string& side, std::span<const Reason> reasons) {
  std::string text;
  for (const Reason& reason : reasons) text += (text.empty() ? " " + side + ": " : "; ") + reason.text;
  return text.empty() ? "" : text + ".";
}

/// What the policy made of the direction and of the next best: the costs that its belief expects, or else its scores. That they are nearly
/// equal comes first, for then the reasons weigh little.
std::string rating(const explain::ActionAccount& taken, const explain::ActionAccount& next) {
  constexpr double kSmallCost = 0.1;
  constexpr double kSmallShare = 0.05;
  const auto nearly = [](bool is_small) { return std::string(is_small ? "the two are nearly equal, but " : ""); };
  if (!taken.worth || !next.worth)
    return nearly(std::abs(taken.probability - next.probability) < kSmallShare) + "the policy gave " + taken.name + " " +
           percent(taken.probability) + " and " + next.name + " " + percent(next.probability);
  const double more = *next.regret_steps() - *taken.regret_steps();
  const std::string& best = more >= 0.0 ? taken.name : next.name;
  const std::string& other = more >= 0.0 ? next.name : taken.name;
  return nearly(std::abs(more) < kSmallCost) + "the rest of the search is expected to cost least after " + best + "; " + other +
         " is expected to cost " + fixed(std::abs(more), 2) + " more (1 = one step without a detection)";
}

/// A column of the table of directions: its name with the unit, what it means, and what it says of a direction.
struct ActionColumn {
  std::string name;
  std::string meaning;
  std::string (*value)(const explain::ActionAccount& action);
};

ActionColumn regret_column(const DecisionAccount& a) {
  const std::string most = fixed(a.most_regret_steps, 0);
  return {"regret (steps)",
          "how much more the rest of the search is expected to cost after this direction than after the best one, in steps without a "
          "detection, if the place of the source became known after the step. The policy ranks the directions by it: the best has 0; " +
              most + " or more is shown as " + most + ".",
          [](const explain::ActionAccount& action) { return action.regret_steps() ? fixed(*action.regret_steps(), 2) : std::string("-"); }};
}

std::vector<ActionColumn> promises() {
  return {{"expected SNR (dB)", "at the end of the step, and how far it may be off",
           [](const explain::ActionAccount& action) {
             return fixed(action.hear.snr.value, 1) + " \u00B1 " + fixed(action.hear.spread.value, 1);
           }},
          {"detects (%)", "probability of a detection at the end of the step",
           [](const explain::ActionAccount& action) { return fixed(100.0 * action.detected, 0); }},
          {"finds (%)", "probability that the source lies within a step length of there",
           [](const explain::ActionAccount& action) { return fixed(100.0 * action.found, 1); }},
          {"finds within 3 steps (%)", "probability that the source is found within three steps of which this is one",
           [](const explain::ActionAccount& action) { return fixed(100.0 * action.found_soon, 1); }},
          {"nearer by (km)", "how much nearer to the source the step is expected to end",
           [](const explain::ActionAccount& action) { return fixed(action.approach.value / 1e3, 2); }},
          {"border", "how deep the step ends in the border strip of the area: - clear of the strip, 1 at the area's edge, more beyond it",
           [](const explain::ActionAccount& action) { return action.border > 0.0 ? fixed(action.border, 2) : std::string("-"); }}};
}

/// How likely a policy that draws lots made the direction; of one that takes the best, how high it rated it.
ActionColumn choice_column(const DecisionAccount& a) {
  const std::string made = has_network(a) ? "" : ", made from the regret";
  const bool draws = a.draw != policy::ActionDraw::kArgmax;
  return {draws ? "chosen with (%)" : "score (%)",
          draws ? "probability with which the policy draws the direction" + made + "."
                : "what the policy made of the direction" + made + ". It takes the direction with the highest score.",
          [](const explain::ActionAccount& action) { return fixed(100.0 * action.probability, 0); }};
}

/// The regret stands in it where the policy ranks by the regret.
std::vector<ActionColumn> columns_of(const DecisionAccount& a) {
  std::vector<ActionColumn> columns{choice_column(a)};
  if (!has_network(a)) columns.push_back(regret_column(a));
  std::ranges::move(promises(), std::back_inserter(columns));
  return columns;
}

}  // namespace

bool has_network(const DecisionAccount& a) {
  return std::ranges::none_of(a.actions, [](const explain::ActionAccount& action) { return action.worth.has_value(); });
}

std::optional<std::size_t> second_best(const DecisionAccount& a) {
  std::optional<std::size_t> best;
  const auto rank = [&a](std::size_t i) { return a.actions[i].worth.value_or(a.actions[i].probability); };
  for (std::size_t i = 0; i < a.actions.size(); ++i) {
    if (i != a.decision.action && (!best || rank(i) > rank(*best))) best = i;
  }
  return best;
}

std::string why_this_direction(const DecisionAccount& a) {
  const explain::ActionAccount& taken = a.actions[a.decision.action];
  const std::optional<std::size_t> second = second_best(a);
  const explain::ActionAccount* const next = second ? &a.actions[*second] : nullptr;
  if (next == nullptr) return "Why " + taken.name + ": the policy has no other direction.";
  std::vector<Reason> reasons = reasons_for(taken, *next, range_between(a.decision.position, taken.end));
  const auto against = std::ranges::find_if(reasons, [](const Reason& reason) { return reason.advantage < 0.0; });
  std::ranges::reverse(against, reasons.end());
  const std::string text = "Why " + taken.name + " and not " + next->name + ": " + rating(taken, *next) + "." +
                           (a.belief_is_the_policys ? " The" : " To an observer who knows the ocean the") + " likeliest place is " +
                           likeliest_place(a) + ".";
  if (reasons.empty()) return text + " Both promise the same.";
  const std::string no_more = " In the next steps " + taken.name + " promises no more than " + next->name +
                              (taken.worth ? "; the cost counts all steps of the search that follow." : ".");
  return text + (against == reasons.begin() ? no_more : listed("For " + taken.name, {reasons.begin(), against})) +
         listed("For " + next->name, {against, reasons.end()});
}

std::string choice_sentence(const DecisionAccount& a) {
  const explain::ActionAccount& taken = a.actions[a.decision.action];
  const explain::ActionAccount& likeliest = a.actions[a.likeliest_action];
  const std::string chose = "It chose " + taken.name;
  if (a.draw == policy::ActionDraw::kArgmax && taken.worth)
    return chose + ": this policy always takes the direction after which the search is expected to cost least.";
  if (a.draw == policy::ActionDraw::kArgmax)
    return chose + ": this policy always takes the direction with the highest score, here " + percent(taken.probability) + ".";
  const std::string drew = chose + ", which had " + percent(taken.probability) + ": this policy draws lots by its probabilities";
  return drew + (a.decision.action == a.likeliest_action
                     ? "."
                     : ", and " + likeliest.name + " was likelier with " + percent(likeliest.probability) + ".");
}

std::string what_weighed_most(const DecisionAccount& a) {
  std::string text = "What weighed most:";
  const char* separator = " ";
  for (const explain::ObservedAccount& o : explain::weightiest(a, 3)) {
    text += separator + o.name + " " + o.value + " (" + factor_to_string(o.part) + ")";
    separator = ", ";
  }
  return text + ".";
}

std::vector<std::string> sentences(const DecisionAccount& a) {
  std::vector<std::string> all{measured_sentence(a), belief_sentence(a)};
  if (a.decision.found) all.push_back(declared_sentence(a));
  if (a.decision.sweeping) {
    all.push_back(sweep_sentence(a));
    return all;  // what the policy would have done, nobody did
  }
  all.push_back(why_this_direction(a));
  if (has_network(a)) all.push_back(what_weighed_most(a));
  for (std::string sentence : {choice_sentence(a), expectation_sentence(a), safety_sentence(a)}) all.push_back(std::move(sentence));
  return all;
}

std::string to_string(explain::Baseline baseline) {
  return baseline == explain::Baseline::kCentre ? "a vehicle in the middle of the area that has heard nothing yet"
                                                : "a vehicle at the same place that has heard nothing yet";
}

std::string completeness_to_string(const explain::Attribution& a) {
  return "the parts add up to " + fixed(a.sum(), 4) + " of " + fixed(a.difference(), 4) + " after " + std::to_string(a.steps) + " steps, " +
         (a.is_complete() ? "complete within " + fixed(a.tolerance, 3)
                          : "NOT complete within " + fixed(a.tolerance, 3) + ": do not trust the parts beyond that gap");
}

std::string to_string(const policy::Reception& reception) {
  const std::string snr = (reception.too_faint ? "under " : "") + fixed(reception.snr.value, 1) + " dB";
  return reception.bearing ? snr + " from " + to_string(*reception.bearing) : snr;
}

std::string to_string(const messages::Bearing& bearing) {
  constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
  std::string text = explain::degrees_to_string(bearing.direction);
  if (bearing.mirror_axis) text += " or " + explain::degrees_to_string(2.0 * *bearing.mirror_axis - bearing.direction);
  return text + " \u00B1 " + fixed(bearing.deviation.value * kDegreesPerRadian, 0) + "\u00B0";
}

std::string actions_markdown(const DecisionAccount& a) {
  const std::vector<ActionColumn> columns = columns_of(a);
  std::string text = "| direction |";
  std::string rule = "|---|";
  std::string meanings;
  for (const ActionColumn& column : columns) {
    text += " " + column.name + " |";
    rule += "---|";
    meanings += "- " + column.name + ": " + column.meaning + "\n";
  }
  text += "\n" + rule + "\n";
  for (const explain::ActionAccount& action : a.actions) {
    text += "| " + action.name + " |";
    for (const ActionColumn& column : columns) text += " " + column.value(action) + " |";
    text += "\n";
  }
  return text + "\n" + meanings;
}

}  // namespace earshot::report
