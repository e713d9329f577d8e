#include "sim/search/episode.hpp"

#include <cassert>

#include "firmware/detector/listener.hpp"

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
    heard_ = listen(world);
  } else {
    surroundings_.start(world, position, source, conditions);
    heard_ = listen(world);
    source_ = surroundings_.nearest_source(position_);
  }
  memory_.start(model, in_domain(world), heard_);
}

/// The whole step at once up to the first look that counts, then look by look.
void Episode::step_and_listen(const SearchWorld& world, NorthEast through_water) {
  const SearchSettings& s = world.settings;
  const double leg_s = s.step_length.value / world.conditions.vehicle_speed.value;
  const std::size_t looks = looks_on_leg(s.listening, leg_s);
  if (looks == 1) {
    move(world, through_water, leg_s);
    heard_ = listen(world);
    return;
  }
  const double look_s = kLookInterval.to_seconds();
  const double rest_s = leg_s - static_cast<double>(looks - 1) * look_s;
  detector::Listener listener;
  Time now;
  for (std::size_t i = 0; i < looks; ++i) {
    const double time_s = i == 0 ? rest_s : look_s;
    const double share = time_s / leg_s;
    move(world, {share * through_water.north, share * through_water.east}, time_s);
    now = now + kLookInterval;
    const policy::Heard look = listen(world);
    listener.take({.time = now, .snr = look.snr, .too_faint = look.too_faint});
  }
  const detector::WindowHeard heard = listener.heard(s.listening, now);
  heard_ = {.snr = heard.snr, .too_faint = heard.too_faint};
}

void Episode::move(const SearchWorld& world, NorthEast through_water, double time_s) {
  if (world.soundscape == nullptr) {
    position_ = position_ + through_water;
    return;
  }
  position_ = position_ + surroundings_.pass(world, through_water, time_s);
  source_ = surroundings_.nearest_source(position_);
  navigation_error_ = surroundings_.navigation_error();
}

policy::Heard Episode::listen(const SearchWorld& world) {
  if (world.soundscape == nullptr) return {.snr = world.snr.at(range_between(position_, source_))};
  return surroundings_.listen(world, position_);
}

double Episode::step(const SearchWorld& world, std::size_t action) {
  assert(record_.end == EpisodeEnd::kRunning);
  const SearchSettings& s = world.settings;
  step_and_listen(world, s.step_length * world.actions[action]);
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
