#include "policy/evaluate/output/figures_json.hpp"

#include <cassert>
#include <nlohmann/json.hpp>

#include "firmware/host/listening/listening_words.hpp"
#include "sim/search/scenario/placement.hpp"

namespace earshot::evaluate {
namespace {

using nlohmann::ordered_json;

ordered_json as_json(const Row& row, Timing timing) {
  const Summary& s = row.summary;
  const TimeToFind& t = row.time_to_find;
  const auto interval = [](const Interval& i) { return ordered_json{i.low, i.high}; };
  const auto in_hours = [&row](double steps) { return hours(steps, row.pace); };
  const Interval& steps_95 = row.intervals.restricted_mean_steps;
  ordered_json json{{"world", row.world},
                    {"policy", row.policy},
                    {"episodes", s.episodes},
                    {"found_fraction", s.found_fraction},
                    {"found_fraction_95", interval(row.found_fraction_95)},
                    {"lower_quartile_hours_to_find", in_hours(t.lower_quartile)},
                    {"median_hours_to_find", in_hours(t.median)},
                    {"upper_quartile_hours_to_find", in_hours(t.upper_quartile)},
                    {"restricted_mean_hours_to_find", in_hours(t.restricted_mean)},
                    {"restricted_mean_hours_to_find_95", interval({in_hours(steps_95.low), in_hours(steps_95.high)})},
                    {"lower_quartile_steps_to_find", t.lower_quartile},
                    {"median_steps_to_find", t.median},
                    {"upper_quartile_steps_to_find", t.upper_quartile},
                    {"restricted_mean_steps_to_find", t.restricted_mean},
                    {"restricted_mean_steps_to_find_95", interval(steps_95)},
                    {"mean_reward", s.mean_reward},
                    {"mean_reward_95", interval(row.intervals.mean_reward)},
                    {"lower_quartile_reward", s.lower_quartile_reward},
                    {"median_reward", s.median_reward},
                    {"median_reward_95", interval(row.intervals.median_reward)},
                    {"upper_quartile_reward", s.upper_quartile_reward},
                    {"left_domain_fraction", s.left_domain_fraction},
                    {"path_over_straight", row.path_over_straight},
                    {"path_over_straight_95", interval(row.intervals.path_over_straight)},
                    {"mean_steps", s.mean_steps},
                    {"mean_detections", s.mean_detections},
                    {"surprised_fraction", row.mismatches.fraction},
                    {"median_look_of_surprise", row.mismatches.median_measurement}};
  if (row.declarations) {
    json["declared_falsely_fraction"] = row.declarations->falsely;
    json["declared_far_off_fraction"] = row.declarations->far_off;
    json["missed_fraction"] = row.declarations->missed;
  }
  if (timing == Timing::kIncluded) {
    json["decision_us"] = 1e6 * row.decision_s;
    json["pondering_us"] = 1e6 * row.refinement_s;
  }
  return json;
}

ordered_json as_json(const FlownTables& tables) {
  return {{"file", tables.file},
          {"sha256", tables.sha256},
          {"tables", tables.count},
          {"signed_by", tables.signed_by.empty() ? ordered_json() : ordered_json(tables.signed_by)}};
}

}  // namespace

std::string title_of(const EvaluationSetup& setup) {
  return std::to_string(setup.episodes) + " searches each in " +
         (setup.worlds.size() == 1 ? setup.worlds.front().name : std::to_string(setup.worlds.size()) + " worlds") + ", source " +
         std::string(search::name_of(setup.settings.placement));
}

ordered_json figures(const EvaluationSetup& setup, std::span<const Row> rows, Timing timing) {
  const search::SearchSettings& settings = setup.settings;
  ordered_json json{{"episodes", setup.episodes}, {"source", search::name_of(settings.placement)}};
  if (settings.placement == search::SourcePlacement::kFixed) {
    json["source_north_m"] = settings.source.north.value;
    json["source_east_m"] = settings.source.east.value;
  }
  if (setup.start_margin_m)
    json["start_margin_m"] = *setup.start_margin_m;
  else
    json["start"] = setup.start;
  json["border_width_m"] = settings.border_width.value;
  json["border_reward"] = settings.border_reward;
  json["max_steps"] = settings.max_steps;
  json["found_by"] = settings.found_by == search::FoundBy::kSearcher ? "searcher" : "simulator";
  json["listening"] = host::word_for(settings.listening.listening);
  json["listening_window_s"] = host::length_s(settings.listening);
  json["trained_by"] = setup.trained_by.empty() ? ordered_json() : ordered_json(setup.trained_by);
  json["warnings"] = std::vector<std::string>(setup.warnings.begin(), setup.warnings.end());
  assert(setup.tables.size() == setup.worlds.size());
  for (std::size_t i = 0; i < setup.worlds.size(); ++i) {
    const WorldFile& world = setup.worlds[i];
    json["worlds"].push_back({{"name", world.name},
                              {"what", world.what},
                              {"seed", world.seed},
                              {"vehicle_depth_m", world.vehicle_depth.value_or(setup.vehicle_depth).value},
                              {"ocean_tables", setup.tables[i] ? as_json(*setup.tables[i]) : ordered_json("own ocean")}});
  }
  for (const Row& row : rows) json["results"].push_back(as_json(row, timing));
  return json;
}

std::string as_json(const EvaluationSetup& setup, std::span<const Row> rows, Timing timing) {
  return figures(setup, rows, timing).dump(1) + "\n";
}

std::string as_suite(const EvaluationSetup& setup, std::span<const Row> rows, const SearchesJson& searches) {
  const Rectangle& area = setup.settings.domain;
  return ordered_json{{"format", 1},
                      {"title", title_of(setup)},
                      {"area",
                       {{"south_m", area.south_west.north.value},
                        {"west_m", area.south_west.east.value},
                        {"north_m", area.north_east.north.value},
                        {"east_m", area.north_east.east.value}}},
                      {"detection_threshold_db", setup.settings.detection_threshold.value},
                      {"figures", figures(setup, rows, Timing::kLeftOut)},
                      {"searches", searches.json()}}
      .dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace earshot::evaluate
