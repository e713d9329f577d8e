#include "policy/evaluate/time_to_find.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace earshot::evaluate {
namespace {

bool has_found(const search::EpisodeRecord& record) {
  return record.end == search::EpisodeEnd::kFound;
}

/// The first of the sorted times by which a share q of all has passed.
double first_by(const std::vector<double>& sorted, double q) {
  const auto place = static_cast<std::size_t>(std::ceil(q * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(place, 1) - 1];
}

}  // namespace

Pace pace_of(const search::World& world) {
  return {.step_s = world.settings.step_length.value / world.conditions.vehicle_speed.value, .max_steps = world.settings.max_steps};
}

double restricted_steps(const search::EpisodeRecord& record, std::uint32_t max_steps) {
  return has_found(record) ? record.steps : max_steps;
}

TimeToFind time_to_find(std::span<const search::EpisodeRecord> records, std::uint32_t max_steps) {
  assert(!records.empty());
  std::vector<double> times;
  double sum = 0.0;
  for (const search::EpisodeRecord& record : records) {
    times.push_back(has_found(record) ? record.steps : std::numeric_limits<double>::infinity());
    sum += restricted_steps(record, max_steps);
  }
  std::ranges::sort(times);
  return {.lower_quartile = first_by(times, 0.25),
          .median = first_by(times, 0.5),
          .upper_quartile = first_by(times, 0.75),
          .restricted_mean = sum / static_cast<double>(records.size())};
}

}  // namespace earshot::evaluate
