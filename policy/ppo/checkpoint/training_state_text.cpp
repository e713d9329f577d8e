#include "policy/ppo/checkpoint/training_state_text.hpp"

#include <nlohmann/json.hpp>

namespace earshot::ppo {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Pcg32::State& random) {
  return {random.state, random.increment};
}

Pcg32::State random_from(const Json& json) {
  return {json.at(0).get<std::uint64_t>(), json.at(1).get<std::uint64_t>()};
}

Json to_json(const WorkerState& worker) {
  Json json{{"random", to_json(worker.random)}, {"episodes", Json::array()}};
  for (const search::EpisodeScript& episode : worker.episodes) {
    json["episodes"].push_back({{"random", to_json(episode.random)}, {"actions", episode.actions}});
  }
  return json;
}

WorkerState worker_from(const Json& json) {
  WorkerState worker{.random = random_from(json.at("random")), .episodes = {}};
  for (const Json& episode : json.at("episodes")) {
    worker.episodes.push_back({random_from(episode.at("random")), episode.at("actions").get<std::vector<std::uint8_t>>()});
  }
  return worker;
}

}  // namespace

Json to_json(const TrainingState& state) {
  Json json{{"steps", state.steps},
            {"seed", state.seed},
            {"adam_steps", state.optimiser.steps},
            {"first_moment", state.optimiser.first_moment},
            {"second_moment", state.optimiser.second_moment},
            {"workers", Json::array()}};
  for (const WorkerState& worker : state.workers) json["workers"].push_back(to_json(worker));
  return json;
}

TrainingState training_state_from(const Json& json) {
  TrainingState state;
  state.steps = json.at("steps").get<std::uint64_t>();
  state.seed = json.at("seed").get<std::uint64_t>();
  state.optimiser = {json.at("adam_steps").get<std::uint64_t>(), json.at("first_moment").get<std::vector<float>>(),
                     json.at("second_moment").get<std::vector<float>>()};
  for (const Json& worker : json.at("workers")) state.workers.push_back(worker_from(worker));
  return state;
}

std::string to_text(const WorkerState& worker) {
  return to_json(worker).dump();
}

WorkerState worker_from_text(std::string_view text) {
  return worker_from(Json::parse(text));
}

}  // namespace earshot::ppo
