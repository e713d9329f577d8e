#include "sim/search/episode/vector_search.hpp"

#include <algorithm>
#include <cassert>

#include "sim/search/streams.hpp"

namespace earshot::search {
namespace {

constexpr std::size_t kExpectedSteps = 1'024;  // of an episode; the list of a longer one grows

}  // namespace

VectorSearch::VectorSearch(const World& world, const policy::ObservationModel& model, const policy::OceanTables& tables,
                           std::size_t environment_count, std::uint64_t seed, std::uint64_t first_stream)
    : VectorSearch(std::span(&world, 1), model, tables, environment_count, seed, first_stream) {}

VectorSearch::VectorSearch(std::span<const World> worlds, const policy::ObservationModel& model, const policy::OceanTables& tables,
                           std::size_t environment_count, std::uint64_t seed, std::uint64_t first_stream)
    : worlds_(worlds),
      model_(model),
      tables_(tables),
      episodes_(environment_count),
      drawn_worlds_(environment_count),
      scripts_(environment_count),
      observations_(environment_count * model.spec.size()),
      final_observations_(environment_count * model.spec.size()),
      rewards_(environment_count),
      ended_(environment_count) {
  assert(std::ranges::all_of(worlds, [](const World& world) { return check(world.settings) == Status::kOk; }));
  random_.reserve(environment_count);
  for (std::size_t i = 0; i < environment_count; ++i) {
    random_.push_back(training_random(seed, first_stream + i));
    scripts_[i].actions.reserve(std::min<std::size_t>(worlds.front().settings.max_steps, kExpectedSteps));
    start(i);
    episodes_[i].observe(slot(observations_, i));
  }
}

void VectorSearch::start(std::size_t environment) {
  scripts_[environment].random = random_[environment].state();
  scripts_[environment].actions.clear();
  if (worlds_.size() > 1) drawn_worlds_[environment] = random_[environment].next() % worlds_.size();
  episodes_[environment].start(worlds_[drawn_worlds_[environment]], model_, tables_, random_[environment]);
}

bool VectorSearch::resume(std::span<const EpisodeScript> scripts) {
  if (scripts.size() != episodes_.size()) return false;
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    random_[i] = Pcg32(scripts[i].random);
    start(i);
    for (const std::uint8_t action : scripts[i].actions) {
      if (action >= action_count() || episodes_[i].record().end != EpisodeEnd::kRunning) return false;
      take(i, action);
    }
    if (episodes_[i].record().end != EpisodeEnd::kRunning) return false;
    episodes_[i].observe(slot(observations_, i));
  }
  return true;
}

/// One step of one episode; whatever an episode's steps draw from random numbers is drawn here.
double VectorSearch::take(std::size_t environment, std::size_t action) {
  scripts_[environment].actions.push_back(static_cast<std::uint8_t>(action));
  return episodes_[environment].step(worlds_[drawn_worlds_[environment]], action);
}

void VectorSearch::step(std::span<const std::size_t> actions) {
  assert(actions.size() == episodes_.size());
  for (std::size_t i = 0; i < episodes_.size(); ++i) {
    Episode& episode = episodes_[i];
    rewards_[i] = static_cast<float>(take(i, actions[i]));
    ended_[i] = episode.record();
    if (ended_[i].end != EpisodeEnd::kRunning) {
      episode.observe(slot(final_observations_, i));
      start(i);
    }
    episode.observe(slot(observations_, i));
  }
}

std::span<const float> VectorSearch::observation(std::size_t environment) const {
  return std::span(observations_).subspan(environment * observation_size(), observation_size());
}

std::span<const float> VectorSearch::final_observation(std::size_t environment) const {
  return std::span(final_observations_).subspan(environment * observation_size(), observation_size());
}

std::span<float> VectorSearch::slot(std::vector<float>& all, std::size_t environment) const {
  return std::span(all).subspan(environment * observation_size(), observation_size());
}

}  // namespace earshot::search
