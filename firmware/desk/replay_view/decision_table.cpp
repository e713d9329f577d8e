#include "firmware/desk/replay_view/decision_table.hpp"

#include <cmath>

#include "firmware/core/compass.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/host/journal/words/rule_event_words.hpp"
#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::replay_view {
namespace {

double seconds_since(Time began, Time time) {
  return static_cast<double>((time - began).us) / 1e6;
}

/// Whole degrees, 0 to 359.
int degrees_towards(const messages::Decision& d) {
  const NorthEast leg = d.waypoint - d.position;
  const Radians bearing = bearing_of(leg.north.value, leg.east.value);
  return static_cast<int>(std::lround(compass_degrees(bearing))) % 360;
}

std::string half_row(const std::optional<messages::Decision>& decision, Time began) {
  if (!decision) return host::formatted("%41s", "not decided");
  const messages::Decision& d = *decision;
  return host::formatted("%8.1f %s%5.1f %-5s %03d %7.3f %7.3f", seconds_since(began, d.time), d.too_faint ? "<" : " ", d.snr.value,
                         d.detected ? "det." : "", degrees_towards(d), d.waypoint.north.value * 1e-3, d.waypoint.east.value * 1e-3);
}

std::string one_way(const std::optional<messages::Decision>& d, Time began) {
  if (!d) return "not decided";
  return host::formatted("at %.1f s towards %03d deg, to %.3f km north, %.3f km east", seconds_since(began, d->time), degrees_towards(*d),
                         d->waypoint.north.value * 1e-3, d->waypoint.east.value * 1e-3);
}

std::string to_string(const Standing& standing, Time began) {
  const bool is_by_rule = standing.rule && standing.health.end_reason == messages::EndReason::kSafetyRule;
  const std::string rule = is_by_rule ? ", " + journal::to_string(*standing.rule) : "";
  const bool was_mismatched = standing.health.mismatch_bits >= messages::kMismatchThreshold_bits;
  return journal::to_string(standing.health, was_mismatched) + host::formatted(" (since %.1f s", seconds_since(began, standing.since)) +
         rule + ")";
}

}  // namespace

std::string decision_table(std::span<const StepPair> pairs, std::uint32_t from_step, Time began) {
  const std::string head = host::formatted("%8s %6s %-5s %3s %7s %7s", "time (s)", "SNR", "", "deg", "north", "east");
  std::string text = host::formatted("%5s  %-39s |  %s\n", "", "then (SNR in dB, det.: a detection)", "now (places in km)") + " step" +
                     head + " |" + head + "\n";
  const StepPair* const parts = parting(pairs);
  for (const StepPair& pair : from(from_step, pairs)) {
    text += host::formatted("%5u", static_cast<unsigned>(pair.step)) + half_row(pair.then, began) + " |" + half_row(pair.now, began);
    if (&pair == parts)
      text += "  parts";
    else if (!pair.is_same())
      text += "  differs";
    text += "\n";
  }
  return text;
}

std::string where_they_part(std::span<const StepPair> pairs, std::uint32_t from_step, Time began) {
  if (pairs.empty()) return "no decision, then or now";
  const std::string first = std::to_string(pairs.front().step);
  const StepPair* const parts = parting(pairs);
  if (parts == nullptr)
    return "the decisions do not part: " + host::counted(pairs.size(), "step") + " from step " + first +
           " on send the vehicle the same ways";
  const bool is_listed = parts->step >= from_step;
  return "the decisions part at step " + std::to_string(parts->step) + (is_listed ? "" : ", before step " + std::to_string(from_step)) +
         ": then " + one_way(parts->then, began) + "; now " + one_way(parts->now, began);
}

std::string what_it_means(const Counterfactual& counterfactual, std::span<const StepPair> pairs) {
  std::string text;
  if (counterfactual.steering)
    text += host::formatted("set-points differ from %.1f s on: ", seconds_since(counterfactual.began, counterfactual.steering->time)) +
            to_string(counterfactual.steering->fields) + "\n";
  if (counterfactual.steering) {
    for (const messages::SafetyEvent& rule : counterfactual.steering->rules) text += "now steers there: " + journal::to_string(rule) + "\n";
  }
  const std::string where =
      counterfactual.gap ? "where record " + std::to_string(*counterfactual.gap) + " is missing" : "at the journal's end";
  text += where + ", then: " + to_string(counterfactual.then_ended, counterfactual.began) +
          "; now: " + to_string(counterfactual.now_ended, counterfactual.began) + "\n";
  if (counterfactual.steering || parting(pairs) != nullptr)
    text +=
        "What stands behind the first difference is no forecast: the fixes and SNRs are those of the vehicle that followed the journal. "
        "One that had followed the other decisions would have been elsewhere, and would have heard something else.\n";
  return text;
}

}  // namespace earshot::replay_view
