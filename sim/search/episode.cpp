#include "sim/search/episode.hpp"

#include <cassert>

namespace earshot::search {
void Episode::start(const SearchWorld& world, const policy::ObservationModel& model, Pcg32& random) {
  const SearchSettings& s = world.settings;
  NorthEast source = s.source;
  NorthEast position;
  do {
    if (s.placement == SourcePlacement::kChanging) source = uniform_in(s.domain, random);
    position = uniform_in(s.start_region, random);
  } while (range_between(position, source) <= s.step_length);
  if (world.soundscape == nullptr) return start_at(world, model, position, source);
  const std::uint64_t high = random.next();
  const std::uint64_t seed = (high << 32U) | random.next();
  start_at(world, model, position, source, Pcg32(seed));
}

void Episode::start_at(const SearchWorld& world, const policy::ObservationModel& model, NorthEast position, NorthEast source,
                       Pcg32 conditions) {
  position_ = position;
  source_ = source;
  navigation_error_ = {};
  record_ = {};
  model_ = &model;
  if (world.soundscape == nullptr) {
    heard_ = {.snr = world.snr.at(range_between(position_, source_))};
  } else {
    surroundings_.start(world, position, source, conditions);
    heard_ = surroundings_.listen(world, position_);
    source_ = surroundings_.nearest_source(position_);
  }
  memory_.start(model, in_domain(world), heard_);
}

void Episode::move(const SearchWorld& world, NorthEast through_water) {
  if (world.soundscape == nullptr) {
    position_ = position_ + through_water;
    heard_.snr = world.snr.at(range_between(position_, source_));
  } else {
    position_ =
        position_ + surroundings_.pass(world, through_water, world.settings.step_length.value / world.conditions.vehicle_speed.value);
    heard_ = surroundings_.listen(world, position_);
    source_ = surroundings_.nearest_source(position_);
    navigation_error_ = surroundings_.navigation_error();
  }
}

double Episode::step(const SearchWorld& world, std::size_t action) {
  assert(record_.end == EpisodeEnd::kRunning);
  const SearchSettings& s = world.settings;
  move(world, s.step_length * world.actions[action]);
  memory_.remember(*model_, in_domain(world), heard_);

  const double reward = step_reward(s, position_, heard_);
  record_.reward += reward;
  record_.steps += 1;
  record_.detections += is_detection(s, heard_) ? 1U : 0U;
  if (range_between(position_, source_) <= s.step_length) {
    record_.end = EpisodeEnd::kFound;
  } else if (!s.domain.contains(position_)) {
    record_.end = EpisodeEnd::kLeftDomain;
  } else if (record_.steps >= s.max_steps) {
    record_.end = EpisodeEnd::kTimeLimit;
  }
  return reward;
}

}  // namespace earshot::search
