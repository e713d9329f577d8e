#include <nlohmann/json.hpp>
#include <numbers>

#include "policy/report/decision_report.hpp"
#include "policy/report/explanation.hpp"

namespace earshot::report {
namespace {

using nlohmann::ordered_json;

ordered_json place(NorthEast p) {
  return {{"north_m", p.north.value}, {"east_m", p.east.value}};
}

template <class Value>
ordered_json or_null(const std::optional<Value>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json conditions(const std::optional<Conditions>& known) {
  if (!known) return nullptr;
  const auto number = [](const auto& quantity) { return quantity ? ordered_json(quantity->value) : ordered_json(); };
  return {{"simulated", known->is_simulated},
          {"source_frequency_hz", number(known->frequency)},
          {"depth_m", number(known->depth)},
          {"speed_mps", number(known->speed)},
          {"area_size", place(known->area_size)},
          {"place", known->place},
          {"date", known->date}};
}

ordered_json measurement(const explain::RecordedDecision& d) {
  ordered_json json{{"step", d.step},        {"time_s", d.time_s()},     {"position", place(d.position)},
                    {"snr_db", d.snr.value}, {"too_faint", d.too_faint}, {"detected", d.detected}};
  if (const auto& bearing = d.bearing) {
    constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
    json["bearing"] = {{"direction_deg", bearing->direction.value * kDegreesPerRadian},
                       {"deviation_deg", bearing->deviation.value * kDegreesPerRadian}};
    if (bearing->mirror_axis) json["bearing"]["mirror_axis_deg"] = bearing->mirror_axis->value * kDegreesPerRadian;
  }
  return json;
}

ordered_json belief(const explain::DecisionAccount& a) {
  const explain::BelievedPlace& b = a.place;
  ordered_json hypotheses = ordered_json::array();
  for (const explain::HypothesisAccount& h : a.hypotheses)
    hypotheses.push_back({{"ocean", h.ocean},
                          {"level_offset_db", h.level_db},
                          {"spread_db", h.spread_db},
                          {"silence_share", h.silence_share},
                          {"moving", h.is_moving},
                          {"probability", h.share}});
  return {{"whose", a.belief_is_the_policys ? "the policy's" : "an observer's"},
          {"likeliest", place(a.area.south_west + b.likeliest)},
          {"likeliest_cell_probability", b.likeliest_share},
          {"mean", place(a.area.south_west + b.mean)},
          {"ellipse",
           {{"semi_major_m", b.ellipse.semi_major.value},
            {"semi_minor_m", b.ellipse.semi_minor.value},
            {"bearing_deg", b.ellipse.bearing.value * 180.0 / std::numbers::pi}}},
          {"area_50_percent_km2", b.smallest_area_km2(0.5)},
          {"area_95_percent_km2", b.smallest_area_km2(0.95)},
          {"hypotheses", hypotheses}};
}

ordered_json actions(const explain::DecisionAccount& a) {
  ordered_json rows = ordered_json::array();
  for (const explain::ActionAccount& action : a.actions)
    rows.push_back({{"direction", action.name},
                    {"probability", action.probability},
                    {"end", place(action.end)},
                    {"expected_snr_db", action.hear.snr.value},
                    {"snr_spread_db", action.hear.spread.value},
                    {"detection_probability", action.detected},
                    {"found_probability", action.found},
                    {"found_within_three_steps_probability", action.found_soon},
                    {"expected_approach_m", action.approach.value},
                    {"border", action.border},
                    {"regret_steps", or_null(action.regret_steps())}});
  return rows;
}

ordered_json attribution(const explain::DecisionAccount& a) {
  ordered_json parts = ordered_json::array();
  for (const explain::ObservedAccount& o : a.observed)
    parts.push_back(
        {{"observation", o.name}, {"about", explain::to_string(o.subject)}, {"seen", o.value}, {"baseline", o.baseline}, {"nats", o.part}});
  const explain::Attribution& g = a.attribution;
  return {{"method", "integrated gradients of the log-probability of the action taken"},
          {"baseline", to_string(a.baseline)},
          {"log_probability", g.at_observation},
          {"log_probability_at_baseline", g.at_baseline},
          {"sum_of_parts", g.sum()},
          {"steps", g.steps},
          {"tolerance", g.tolerance},
          {"complete", g.is_complete()},
          {"parts", parts}};
}

}  // namespace

std::string as_json(const DecisionReport& report) {
  const explain::DecisionAccount& a = report.account;
  ordered_json measurements = ordered_json::array();
  for (const explain::RecordedDecision& d : report.measurements()) measurements.push_back(measurement(d));
  ordered_json json{{"step", a.decision.step},
                    {"journal", report.flight.journal_path.string()},
                    {"policy", report.flight.policy_path.string()},
                    {"conditions", conditions(report.flight.conditions)},
                    {"taken", a.actions[a.decision.action].name},
                    {"likeliest", a.actions[a.likeliest_action].name},
                    {"waypoint", place(a.decision.waypoint)},
                    {"changed_by_safety_layer", a.decision.overridden},
                    {"surprise_bits", a.decision.mismatch_bits()},
                    {"sweeping", a.decision.sweeping},
                    {"found_probability", a.decision.found ? ordered_json(a.decision.found->probability) : ordered_json()},
                    {"summary", sentences(a)},
                    {"looks", measurements},
                    {"belief", belief(a)},
                    {"actions", actions(a)},
                    {"attribution", attribution(a)}};
  return json.dump(1) + "\n";
}

}  // namespace earshot::report
