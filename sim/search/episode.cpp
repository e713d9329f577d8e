#include "sim/search/episode.hpp"

#include <cassert>

#include "firmware/detector/threshold_detector.hpp"

namespace earshot::search {
namespace {

NorthEast uniform_in(const Rectangle& area, Pcg32& random) {
  const double north = random.uniform_double();
  const double east = random.uniform_double();
  return {area.south_west.north + north * (area.north_east.north - area.south_west.north),
          area.south_west.east + east * (area.north_east.east - area.south_west.east)};
}

}  // namespace

void Episode::start(const SearchWorld& world, const policy::ObservationModel& model, Pcg32& random) {
  const SearchSettings& s = world.settings;
  NorthEast source = s.source;
  NorthEast position;
  do {
    if (s.placement == SourcePlacement::kChanging) source = uniform_in(s.domain, random);
    position = uniform_in(s.start_region, random);
  } while (range_between(position, source) <= s.step_length);
  start_at(world, model, position, source);
}

void Episode::start_at(const SearchWorld& world, const policy::ObservationModel& model, NorthEast position, NorthEast source) {
  position_ = position;
  source_ = source;
  snr_ = world.snr.at(range_between(position_, source_));
  model_ = &model;
  memory_.start(model, position_ - world.settings.domain.south_west, {.snr = snr_});
  record_ = {};
}

double Episode::step(const SearchWorld& world, std::size_t action) {
  assert(record_.end == EpisodeEnd::kRunning);
  const SearchSettings& s = world.settings;
  position_ = position_ + s.step_length * world.actions[action];
  const Meters range = range_between(position_, source_);
  snr_ = world.snr.at(range);
  memory_.remember(*model_, position_ - s.domain.south_west, {.snr = snr_});

  const double reward = step_reward(s, position_, snr_);
  record_.reward += reward;
  record_.steps += 1;
  record_.detections += detector::ThresholdDetector{s.detection_threshold}.detects(snr_) ? 1U : 0U;
  if (range <= s.step_length) {
    record_.end = EpisodeEnd::kFound;
  } else if (!s.domain.contains(position_)) {
    record_.end = EpisodeEnd::kLeftDomain;
  } else if (record_.steps >= s.max_steps) {
    record_.end = EpisodeEnd::kTimeLimit;
  }
  return reward;
}

}  // namespace earshot::search
