#include "sim/search/vector_search.hpp"

#include <cassert>

namespace earshot::search {

VectorSearch::VectorSearch(const SearchWorld& world, const policy::ObservationModel& model, std::size_t environment_count,
                           std::uint64_t seed)
    : world_(world),
      model_(model),
      episodes_(environment_count),
      observations_(environment_count * model.spec.size()),
      final_observations_(environment_count * model.spec.size()),
      rewards_(environment_count),
      ended_(environment_count) {
  assert(check(world.settings) == Status::kOk);
  random_.reserve(environment_count);
  for (std::size_t i = 0; i < environment_count; ++i) {
    random_.emplace_back(seed, i);
    episodes_[i].start(world_, model_, random_[i]);
    episodes_[i].observe(slot(observations_, i));
  }
}

void VectorSearch::step(std::span<const std::size_t> actions) {
  assert(actions.size() == episodes_.size());
  for (std::size_t i = 0; i < episodes_.size(); ++i) {
    Episode& episode = episodes_[i];
    rewards_[i] = static_cast<float>(episode.step(world_, actions[i]));
    ended_[i] = episode.record();
    if (ended_[i].end != EpisodeEnd::kRunning) {
      episode.observe(slot(final_observations_, i));
      episode.start(world_, model_, random_[i]);
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
