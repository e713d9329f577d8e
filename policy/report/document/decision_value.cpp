#include "policy/report/document/decision_value.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "policy/explain/wording.hpp"
#include "policy/report/document/json_values.hpp"
#include "policy/report/explanation.hpp"
#include "policy/report/page/page_template.hpp"
#include "sim/search/actions/compass_directions.hpp"

namespace earshot::report {
namespace {

using nlohmann::ordered_json;

constexpr int kShareDigits = 4;  ///< a hundredth of a percent
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

ordered_json bearing_value(const std::optional<messages::Bearing>& bearing) {
  if (!bearing) return nullptr;
  const std::optional<Radians>& axis = bearing->mirror_axis;
  return {{"toward_deg", compass_value(bearing->direction)},
          {"deviation_deg", rounded(bearing->deviation.value * kDegreesPerRadian, 1)},
          {"mirror_deg", axis ? compass_value(2.0 * *axis - bearing->direction) : ordered_json()}};
}

/// Of a policy that is not there: the compass directions that every policy has.
std::string direction_of(const explain::RecordedDecision& decision) {
  const std::size_t count = decision.action_logits().size();
  return decision.action < count ? explain::direction_name(search::compass_directions(count)[decision.action]) : "";
}

ordered_json actions_of(const explain::DecisionAccount& a) {
  ordered_json rows = ordered_json::array();
  for (std::size_t i = 0; i < a.actions.size(); ++i) {
    const explain::ActionAccount& action = a.actions[i];
    const std::optional<double> regret = action.regret_steps();
    rows.push_back({{"name", action.name},
                    {"score", rounded(static_cast<double>(a.decision.action_logits()[i]), kShareDigits)},
                    {"probability", rounded(action.probability, kShareDigits)},
                    {"expected_snr_db", rounded(action.hear.snr.value, 1)},
                    {"expected_snr_spread_db", rounded(action.hear.spread.value, 1)},
                    {"detected", rounded(action.detected, kShareDigits)},
                    {"found", rounded(action.found, kShareDigits)},
                    {"approach_m", rounded(action.approach.value, 0)},
                    {"regret_steps", regret ? rounded(std::min(*regret, a.most_regret_steps), 3) : ordered_json()}});
  }
  return rows;
}

ordered_json hypotheses_of(const explain::DecisionAccount& a) {
  ordered_json rows = ordered_json::array();
  for (const explain::HypothesisAccount& h : a.hypotheses)
    rows.push_back({{"ocean", h.ocean},
                    {"level_db", rounded(h.level_db, 1)},
                    {"spread_db", rounded(h.spread_db, 1)},
                    {"silence_share", rounded(h.silence_share, kShareDigits)},
                    {"is_moving", h.is_moving},
                    {"share", rounded(h.share, kShareDigits)}});
  return rows;
}

ordered_json observed_of(const explain::DecisionAccount& a) {
  const bool was_moved = has_network(a) && !a.decision.sweeping;  // a sweep is no choice of the policy
  ordered_json rows = ordered_json::array();
  for (const explain::ObservedAccount& o : a.observed)
    rows.push_back({{"name", o.name}, {"value", o.value}, {"part", was_moved ? rounded(o.part, 3) : ordered_json()}});
  return rows;
}

ordered_json belief_value(const explain::DecisionAccount& a) {
  const explain::BelievedPlace& b = a.place;
  const double major = b.ellipse.semi_major.value;
  const double minor = b.ellipse.semi_minor.value;
  return {{"is_the_policys", a.belief_is_the_policys},
          {"cells_north", b.cells_north},
          {"cells_east", b.cells_east},
          {"south_west", place_value(a.area.south_west)},
          {"size", place_value(b.area_size)},
          {"area_of_cell", base64(area_of_cells(b.probability))},
          {"likeliest", place_value(a.area.south_west + b.likeliest)},
          {"likeliest_share", rounded(b.likeliest_share, kShareDigits)},
          {"mean", place_value(a.area.south_west + b.mean)},
          {"ellipse",
           {{"semi_major_m", rounded(major, 1)},
            {"semi_minor_m", rounded(minor, 1)},
            {"bearing_deg", rounded(b.ellipse.bearing.value * kDegreesPerRadian, 1)}}},
          {"spread_m", rounded(std::hypot(major, minor), 1)},
          {"area_50_km2", rounded(b.smallest_area_km2(0.5), 2)},
          {"area_90_km2", rounded(b.smallest_area_km2(0.9), 2)}};
}

}  // namespace

std::vector<std::uint8_t> area_of_cells(const std::vector<double>& probability) {
  std::vector<std::size_t> order(probability.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return probability[a] > probability[b]; });
  std::vector<std::uint8_t> areas(probability.size());
  double sum = 0.0;
  double likelier = 0.0;  // those that are as likely do not count
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && probability[order[i]] < probability[order[i - 1]]) likelier = sum;
    areas[order[i]] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(likelier, 0.0, 1.0)));
    sum += probability[order[i]];
  }
  return areas;
}

ordered_json decision_value(double time_s, const explain::RecordedDecision& d, const std::optional<explain::DecisionAccount>& account) {
  const std::optional<std::size_t> second = account && !d.sweeping ? second_best(*account) : std::nullopt;
  return {{"step", d.step},
          {"time_s", rounded(time_s, 3)},
          {"at", place_value(d.position)},
          {"snr_db", rounded(d.snr.value, 2)},
          {"too_faint", d.too_faint},
          {"detected", d.detected},
          {"bearing", bearing_value(d.bearing)},
          {"waypoint", place_value(d.waypoint)},
          {"direction", account ? account->actions[d.action].name : direction_of(d)},
          {"sweeping", d.sweeping},
          {"overridden", d.overridden},
          {"declared", d.found ? place_value(d.found->likeliest) : ordered_json()},
          {"reasons", account ? sentences(*account) : std::vector<std::string>{}},
          {"actions", account ? actions_of(*account) : ordered_json::array()},
          {"taken", d.action},
          {"second_best", second ? ordered_json(*second) : ordered_json()},
          {"hypotheses", account ? hypotheses_of(*account) : ordered_json::array()},
          {"observed", account ? observed_of(*account) : ordered_json::array()},
          {"belief", account ? belief_value(*account) : ordered_json()}};
}

}  // namespace earshot::report
