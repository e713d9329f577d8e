#include "policy/report/explanation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include "firmware/core/math.hpp"
#include "firmware/host/text/duration.hpp"
#include "policy/report/html.hpp"

namespace earshot::report {
namespace {

using explain::DecisionAccount;
using explain::fixed;

constexpr std::size_t kMeasurementsShown = 6;

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
  const std::string threshold = fixed(a.detection_threshold.value, 0) + " dB";
  if (a.decision.too_faint) return "The signal was too faint to measure: the SNR is below " + fixed(a.decision.snr.value, 1) + " dB.";
  return "It measured an SNR of " + to_string(a.decision.reception()) + ", " +
         (a.decision.detected ? "a detection (threshold " + threshold + ")." : "below the threshold of " + threshold + ": no detection.");
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
  return "At the end of this step it expects an SNR of " + fixed(taken.hear.snr.value, 1) + " dB, give or take " +
         fixed(taken.hear.spread.value, 1) + " dB: a detection with " + percent(taken.detected) + ", the source found with " +
         percent(taken.found) + ".";
}

std::string safety_sentence(const DecisionAccount& a) {
  if (!a.decision.overridden) return "The safety layer left the way-point as it was.";
  const NorthEast wanted = a.actions[a.decision.action].end;
  return "The safety layer moved the way-point by " + fixed(range_between(wanted, a.decision.waypoint).value, 0) + " m, to " +
         place_to_string(a.decision.waypoint) + ".";
}

/// "0.90 km"
std::string nearer(const explain::ActionAccount& action) {
  return fixed(action.approach.value / 1e3, 2) + " km";
}

/// Of the directions that were not taken the one that the policy made most of.
const explain::ActionAccount* next_best(const DecisionAccount& a) {
  const explain::ActionAccount* best = nullptr;
  const auto rank = [](const explain::ActionAccount& action) { return action.worth.value_or(action.probability); };
  for (std::size_t i = 0; i < a.actions.size(); ++i) {
    if (i != a.decision.action && (best == nullptr || rank(a.actions[i]) > rank(*best))) best = &a.actions[i];
  }
  return best;
}

/// By how much the search is expected to cost more after this direction than after the best one, in steps without a detection.
double regret(double worth) {
  return 1.0 / std::max(worth, 1e-9) - 1.0;
}

/// What the policy made of the direction and of the next best: the costs that its belief expects, or else its probabilities.
std::string rating(const explain::ActionAccount& taken, const explain::ActionAccount& next) {
  constexpr double kSmallCost = 0.1;
  constexpr double kSmallShare = 0.05;
  constexpr const char* kSmall = ", a small difference";
  if (!taken.worth || !next.worth)
    return "the policy gave " + taken.name + " " + percent(taken.probability) + " and " + next.name + " " + percent(next.probability) +
           (std::abs(taken.probability - next.probability) < kSmallShare ? kSmall : "");
  const double more = regret(*next.worth) - regret(*taken.worth);
  const std::string& best = more >= 0.0 ? taken.name : next.name;
  const std::string& other = more >= 0.0 ? next.name : taken.name;
  return "the rest of the search is expected to cost least after " + best + "; " + other + " costs " + fixed(std::abs(more), 2) +
         " steps without a detection more" + (std::abs(more) < kSmallCost ? kSmall : "");
}

constexpr const char* kTimes = "\u00D7 ";

/// "20 000"
std::string grouped(long number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, "\u202F");
  return digits;
}

/// An exponent as it stands beside a ten.
std::string superscript(int power) {
  constexpr std::array<const char*, 10> kDigits{"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                                "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = power < 0 ? "\u207B" : "";
  for (const char digit : std::to_string(std::abs(power))) text += kDigits[static_cast<std::size_t>(digit - '0')];
  return text;
}

/// What a part of the log-probability is: its number, its bar and what it does to the chance.
std::string part_cells(double part, double largest) {
  return "<td>" + std::string(part >= 0.0 ? "+" : "") + fixed(part, 2) + "</td>" + signed_bar_cell(largest > 0.0 ? part / largest : 0.0) +
         "<td>" + factor_to_string(part) + "</td>";
}

std::string observed_row(const explain::ObservedAccount& o, double largest) {
  return "<tr><td class=\"left\">" + escaped(o.name) + "</td><td>" + o.value + "</td><td>" + o.baseline + "</td>" +
         part_cells(o.part, largest) + "</tr>\n";
}

constexpr const char* kObservedHead =
    "<div class=\"table\"><table>\n<tr><th "
    "class=\"left\">observation</th><th>seen</th><th>baseline</th><th>part</th><th>against, for</th><th>chance</th></tr>\n";

double largest_part(const std::vector<explain::ObservedAccount>& observed) {
  double largest = 0.0;
  for (const explain::ObservedAccount& o : observed) largest = std::max(largest, std::abs(o.part));
  return largest;
}

}  // namespace

std::string why_this_direction(const DecisionAccount& a) {
  constexpr double kWorthNaming = 0.01;
  const explain::ActionAccount& taken = a.actions[a.decision.action];
  const explain::ActionAccount* const next = next_best(a);
  if (next == nullptr) return "Why " + taken.name + ": the policy has no other direction.";
  const std::string rated = "Why " + taken.name + " and not " + next->name + ": " + rating(taken, *next) + ". The likeliest place is " +
                            likeliest_place(a) + "; ";
  const std::string promised =
      taken.name + " promises to find the source within three steps with " + percent(taken.found_soon) + ", " + next->name;
  const bool is_near = std::max(taken.found_soon, next->found_soon) >= kWorthNaming;
  const bool is_alike = percent(taken.found_soon) == percent(next->found_soon);
  if (is_near && !is_alike) return rated + promised + " with " + percent(next->found_soon) + ".";
  return rated + (is_near ? promised + " as much" : "neither finds it within three steps") + "; on average over the belief " + taken.name +
         " comes " + nearer(taken) + " nearer and detects it with " + percent(taken.detected) + ", " + next->name + " " + nearer(*next) +
         " and " + percent(next->detected) + ".";
}

std::string choice_sentence(const DecisionAccount& a) {
  const explain::ActionAccount& taken = a.actions[a.decision.action];
  const explain::ActionAccount& likeliest = a.actions[a.likeliest_action];
  const std::string chose = "It chose " + taken.name;
  if (a.draw == policy::ActionDraw::kArgmax)
    return chose + ": this policy always takes the direction with the highest probability, here " + percent(taken.probability) + ".";
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
  if (!a.actions[a.decision.action].worth) all.push_back(what_weighed_most(a));
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

std::string factor_to_string(double part) {
  const double factor = std::exp(part);
  if (factor >= 0.01 && factor < 100.0) return kTimes + fixed(factor, 2);
  const int power = static_cast<int>(std::floor(std::log10(factor)));
  if (power < -4 || power > 5) return kTimes + fixed(factor / std::pow(10.0, power), 1) + "\u00B7" + "10" + superscript(power);
  const double unit = std::pow(10.0, power - 1);  // two digits are certain
  return kTimes + (power < 0 ? fixed(factor, 1 - power) : grouped(std::lround(std::round(factor / unit) * unit)));
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

std::string measurements_table(std::span<const explain::RecordedDecision> measurements) {
  std::string text = "<div class=\"table\"><table>\n<tr><th>step</th><th>at</th><th>north (km)</th><th>east (km)</th><th>SNR</th></tr>\n";
  for (std::size_t i = measurements.size(); i > 0 && measurements.size() - i < kMeasurementsShown; --i) {
    const explain::RecordedDecision& measurement = measurements[i - 1];
    text += "<tr><td>" + std::to_string(measurement.step) + "</td><td>" +
            host::duration(measurement.time_s() - measurements.front().time_s()) + "</td><td>" +
            fixed(measurement.position.north.value / 1e3, 2) + "</td><td>" + fixed(measurement.position.east.value / 1e3, 2) + "</td><td" +
            (measurement.detected ? " class=\"heard\"" : "") + ">" + to_string(measurement.reception()) +
            (measurement.detected ? " &#9679;" : "") + "</td></tr>\n";
  }
  return text + "</table></div>\n";
}

std::string actions_table(const DecisionAccount& a) {
  std::string text =
      "<div class=\"table\"><table>\n<tr><th class=\"left\">direction</th><th>chosen with (%)</th><th>expected SNR (dB)</th><th>detects "
      "(%)</th>"
      "<th>finds (%)</th><th>finds within 3 steps (%)</th><th>nearer by (km)</th><th>border</th></tr>\n";
  for (std::size_t i = 0; i < a.actions.size(); ++i) {
    const explain::ActionAccount& action = a.actions[i];
    const bool is_taken = i == a.decision.action;
    text += std::string("<tr><td class=\"left\">") + (is_taken ? "<b>" + action.name + "</b> taken" : action.name) + "</td>" +
            percent_cell("", action.probability, is_taken) + "<td>" + fixed(action.hear.snr.value, 1) + " &plusmn; " +
            fixed(action.hear.spread.value, 1) + "</td><td>" + fixed(100.0 * action.detected, 0) + "</td><td>" +
            fixed(100.0 * action.found, 1) + "</td><td>" + fixed(100.0 * action.found_soon, 1) + "</td><td>" +
            fixed(action.approach.value / 1e3, 2) + "</td><td>" + (action.border > 0.0 ? fixed(action.border, 2) : "-") + "</td></tr>\n";
  }
  return text + "</table></div>\n";
}

std::string attribution_tables(const DecisionAccount& a, std::size_t rows) {
  const std::vector<explain::ObservedAccount> top = explain::weightiest(a, rows);
  double rest = a.attribution.sum();
  for (const explain::ObservedAccount& o : top) rest -= o.part;
  const double largest = std::max(largest_part(top), std::abs(rest));
  std::string text = kObservedHead;
  for (const explain::ObservedAccount& o : top) text += observed_row(o, largest);
  if (a.observed.size() > top.size())
    text += "<tr><td class=\"left\">the other " + std::to_string(a.observed.size() - top.size()) + "</td><td></td><td></td>" +
            part_cells(rest, largest) + "</tr>\n";
  text += "</table></div>\n<p>In all";
  const char* separator = ": ";
  for (const explain::SubjectAccount& subject : explain::by_subject(a)) {
    text += separator + std::string(explain::to_string(subject.subject)) + " " + factor_to_string(subject.part);
    separator = ", ";
  }
  return text + ". Compared with " + to_string(a.baseline) + ", for which " + a.actions[a.decision.action].name + " had " +
         percent(std::exp(a.attribution.at_baseline)) + "; " + completeness_to_string(a.attribution) + ".</p>\n";
}

std::string observation_table(const DecisionAccount& a) {
  std::string text = kObservedHead;
  const double largest = largest_part(a.observed);
  for (const explain::ObservedAccount& o : a.observed) text += observed_row(o, largest);
  return text + "</table></div>\n";
}

}  // namespace earshot::report
