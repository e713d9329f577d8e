#include "sim/search/episode/episode.hpp"

#include <cassert>
#include <optional>

#include "firmware/detector/snr_window.hpp"
#include "sim/search/reward/step_reward.hpp"

namespace earshot::search {
void Episode::start(const World& world, const policy::ObservationModel& model, const policy::OceanTables& tables, Pcg32& random) {
  const SearchSettings& s = world.settings;
  NorthEast source = s.source;
  NorthEast position;
  do {
    if (s.placement == SourcePlacement::kChanging) source = uniform_in(s.domain, random);
    position = uniform_in(s.start_region, random);
  } while (range_between(position, source) <= s.step_length);
  start_at(world, model, tables, position, source, Surroundings::stream_from(world, random));
}

void Episode::start_at(const World& world, const policy::ObservationModel& model, const policy::OceanTables& tables, NorthEast position,
                       NorthEast source, Pcg32 conditions) {
  position_ = position;
  navigation_error_ = {};
  record_ = {};
  model_ = &model;
  tables_ = &tables;
  surroundings_.start(world, position, source, conditions);
  reception_ = surroundings_.listen(world, position_);
  source_ = surroundings_.nearest_source(position_);
  memory_.start(model, tables, in_domain(world), reception_);
}

/// The whole step at once up to the first measurement that counts, then measurement by measurement.
void Episode::step_and_listen(const World& world, NorthEast through_water) {
  const SearchSettings& s = world.settings;
  const double leg_s = s.step_length.value / world.conditions.vehicle_speed.value;
  const std::size_t measurements = measurements_on_leg(s.listening, leg_s);
  if (measurements == 1) {
    move(world, through_water, leg_s);
    reception_ = surroundings_.listen(world, position_);
    return;
  }
  const double measurement_s = kMeasurementInterval.to_seconds();
  const double rest_s = leg_s - static_cast<double>(measurements - 1) * measurement_s;
  detector::SnrWindow snr_window;
  std::optional<messages::Bearing> bearing;  // of the last measurement that had one
  Time now;
  for (std::size_t i = 0; i < measurements; ++i) {
    const double time_s = i == 0 ? rest_s : measurement_s;
    const double share = time_s / leg_s;
    move(world, {share * through_water.north, share * through_water.east}, time_s);
    now = now + kMeasurementInterval;
    const policy::Reception measurement = surroundings_.listen(world, position_);
    snr_window.take({.time = now, .snr = measurement.snr, .too_faint = measurement.too_faint});
    if (measurement.bearing) bearing = measurement.bearing;
  }
  const detector::WindowReception window = snr_window.reception(s.listening, now);
  reception_ = {.snr = window.snr, .too_faint = window.too_faint, .bearing = bearing};
}

void Episode::move(const World& world, NorthEast through_water, double time_s) {
  position_ = position_ + surroundings_.pass(world, through_water, time_s);
  source_ = surroundings_.nearest_source(position_);
  navigation_error_ = surroundings_.navigation_error();
}

double Episode::step(const World& world, std::size_t action) {
  assert(record_.end == EpisodeEnd::kRunning);
  const SearchSettings& s = world.settings;
  step_and_listen(world, s.step_length * world.actions[action]);
  memory_.remember(*model_, *tables_, in_domain(world), reception_);

  const double reward = step_reward(s, position_, reception_);
  record_.reward += reward;
  record_.steps += 1;
  record_.detections += is_detection(s, reception_) ? 1U : 0U;
  if (s.found_by == FoundBy::kSimulator && range_between(position_, source_) <= s.step_length) {
    record_.end = EpisodeEnd::kFound;
  } else if (!s.domain.contains(position_)) {
    record_.end = EpisodeEnd::kLeftDomain;
  } else if (record_.steps >= s.max_steps) {
    record_.end = EpisodeEnd::kTimeLimit;
  }
  return reward;
}

}  // namespace earshot::search
