#include "firmware/desk/replay_view/replay_json.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/desk/replay_view/findings.hpp"
#include "firmware/host/journal/words/rule_event_words.hpp"
#include "firmware/host/journal/words/sentences.hpp"

namespace earshot::replay_view {
namespace {

using Json = nlohmann::ordered_json;

double seconds_since(Time began, Time time) {
  return static_cast<double>((time - began).us) / 1e6;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json fields_json(std::span<const FieldDifference> fields) {
  Json json = Json::array();
  for (const FieldDifference& f : fields) json.push_back({{"field", f.field}, {"then", f.then}, {"now", f.now}});
  return json;
}

Json decision_json(const std::optional<messages::Decision>& decision, Time began) {
  if (!decision) return nullptr;
  Json json{{"time_s", seconds_since(began, decision->time)}};
  json.update(journal::fields_of(*decision));
  return json;
}

Json standing_json(const Standing& standing, Time began) {
  Json json{{"since_s", seconds_since(began, standing.since)}};
  const Json health = journal::fields_of(standing.health);
  for (const char* key : {"state", "end_reason", "steps_taken"}) json[key] = health.at(key);
  json["rule"] = standing.rule ? Json(journal::to_string(*standing.rule)) : Json();
  return json;
}

}  // namespace

Json replay_json(const board::ReplayResult& result, double took_s, std::uint32_t from_step) {
  const double mission_s = seconds_since(result.began, result.ended);
  Json difference;
  if (const auto& d = result.difference)
    difference = {{"record", d->record},
                  {"time_s", seconds_since(result.began, d->time)},
                  {"channel", d->channel},
                  {"channel_now", d->now ? Json(d->now->channel) : Json()},
                  {"fields", fields_json(fields_of(*d))}};
  Json damages = Json::array();
  for (const host::JournalDamage& damage : result.damages) {
    damages.push_back({{"offset", damage.offset}, {"bytes", damage.bytes}});
    if (!damage.part.empty()) damages.back()["file"] = damage.part;
  }
  return {{"same", !result.difference},
          {"whole", !result.gap && result.closing.has_value() && result.records_behind_end == 0 && result.damages.empty()},
          {"from_step", from_step},
          {"inputs", result.inputs},
          {"turns", result.turns},
          {"decisions", result.decisions},
          {"mission_s", mission_s},
          {"times_real_time", mission_s / std::max(took_s, 1e-6)},
          {"difference", std::move(difference)},
          {"first_missing_record", or_null(result.gap)},
          {"ended_in_order", result.closing.has_value()},
          {"records_behind_end", result.records_behind_end},
          {"damages", std::move(damages)}};
}

Json what_if_json(const Counterfactual& counterfactual, std::span<const StepPair> pairs, std::uint32_t from_step) {
  Json steps = Json::array();
  for (const StepPair& pair : from(from_step, pairs))
    steps.push_back({{"step", pair.step},
                     {"same", pair.is_same()},
                     {"then", decision_json(pair.then, counterfactual.began)},
                     {"now", decision_json(pair.now, counterfactual.began)}});
  const StepPair* const parts = parting(pairs);
  Json steering;
  if (counterfactual.steering)
    steering = {{"time_s", seconds_since(counterfactual.began, counterfactual.steering->time)},
                {"fields", fields_json(counterfactual.steering->fields)}};
  return {{"parting_step", parts == nullptr ? Json() : Json(parts->step)},
          {"setpoints_differ", std::move(steering)},
          {"inputs_are", "those of the vehicle that followed the journal, behind the parting too"},
          {"then_ended", standing_json(counterfactual.then_ended, counterfactual.began)},
          {"now_ended", standing_json(counterfactual.now_ended, counterfactual.began)},
          {"first_missing_record", or_null(counterfactual.gap)},
          {"steps", std::move(steps)}};
}

std::string replay_text(Json replay, Json what_if) {
  const Json all{{"replay", std::move(replay)}, {"what_if", std::move(what_if)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace earshot::replay_view
