#include "policy/evaluate/evaluation.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "policy/baselines/learned.hpp"
#include "sim/search/streams.hpp"

namespace earshot::evaluate {
namespace {

using std::chrono::steady_clock;

const policy::ObservationModel kSeesNothing;  // searchers remember for themselves
const policy::OceanTables kNoOceans;

/// Which episode it is, and what it draws from.
struct Turn {
  std::size_t number;
  Pcg32 starts;
  Pcg32 actions;
};

template <class Work>
double seconds_to(Work work) {
  const steady_clock::time_point began = steady_clock::now();
  work();
  return std::chrono::duration<double>(steady_clock::now() - began).count();
}

/// Takes down what the searcher says of where the vehicle is. @return whether it rightly says that the source is found
bool take_down(const baselines::Searcher& searcher, const search::Episode& episode, Meters step_length, Flight& flight) {
  const std::optional<bool> declares = searcher.declares_found();
  if (!declares) return false;
  if (!flight.declarations) flight.declarations.emplace();
  Declarations& all = *flight.declarations;
  const Meters off = range_between(episode.position(), episode.source());
  const bool is_within = off <= step_length;
  all.was_within |= is_within;
  all.rightly |= is_within && *declares;
  all.falsely |= !is_within && *declares;
  all.far_off |= off > 1.5 * step_length && *declares;
  return is_within && *declares;
}

/// Takes note of the first measurement that was a mismatch. @param measurement  which it was, from 1
void note_mismatch(std::optional<bool> is_mismatched, std::size_t measurement, Flight& flight) {
  if (!is_mismatched) return;
  if (std::isnan(flight.measurements_to_mismatch)) flight.measurements_to_mismatch = std::numeric_limits<double>::infinity();
  if (*is_mismatched) flight.measurements_to_mismatch = std::min(flight.measurements_to_mismatch, static_cast<double>(measurement));
}

Flight fly_one(baselines::Searcher& searcher, const search::World& world, const Turn& turn, search::Episode& episode,
               const Watcher& watcher) {
  Flight flight;
  Pcg32 starts = turn.starts;
  searcher.begin(turn.actions);
  episode.start(world, kSeesNothing, kNoOceans, starts);
  const Meters to_source = range_between(episode.position(), episode.source());
  flight.straight_m = (to_source - world.settings.step_length).value;
  while (true) {
    flight.record = episode.record();
    const bool is_over = flight.record.end != search::EpisodeEnd::kRunning;
    if (is_over && !searcher.declares_found()) break;
    const NorthEast before = episode.position();
    const baselines::DecisionInput input{
        .position = episode.believed_position(), .reception = episode.reception(), .vehicle = before, .source = episode.source()};
    std::size_t action = 0;
    const double took_s = seconds_to([&] { action = searcher.choose(input); });
    const bool is_declared = take_down(searcher, episode, world.settings.step_length, flight);
    if (is_declared && world.settings.found_by == search::FoundBy::kSearcher) flight.record.end = search::EpisodeEnd::kFound;
    if (flight.record.end != search::EpisodeEnd::kRunning) break;  // what was heard last made it say something, at most
    flight.decision_s += took_s;
    note_mismatch(searcher.is_mismatched(), episode.record().steps + std::size_t{1}, flight);
    if (watcher) watcher(turn.number, episode, flight.record.end);
    flight.refinement_s += seconds_to([&searcher] { searcher.refine(); });
    episode.step(world, action);
    flight.path_m += range_between(before, episode.position()).value;
  }
  if (watcher) watcher(turn.number, episode, flight.record.end);
  return flight;
}

double mean_over_decisions(std::span<const Flight> flights, double Flight::*time_s) {
  double sum_s = 0.0;
  double decisions = 0.0;
  for (const Flight& flight : flights) {
    sum_s += flight.*time_s;
    decisions += flight.record.steps;
  }
  return sum_s / decisions;
}

}  // namespace

std::vector<Flight> fly(baselines::Searcher& searcher, const search::World& world, Episodes episodes, std::uint64_t seed,
                        const Watcher& watcher) {
  std::vector<Flight> flights;
  search::Episode episode;
  for (std::size_t i = episodes.first; i < episodes.end; i += episodes.stride)
    flights.push_back(fly_one(searcher, world, {i, search::evaluation_random(seed, 2 * i), search::evaluation_random(seed, 2 * i + 1)},
                              episode, watcher));
  return flights;
}

std::vector<search::EpisodeRecord> evaluate(const policy::FrozenPolicy& policy, const policy::OceanTables& tables, policy::ActionDraw draw,
                                            const search::World& world, std::size_t episodes, std::uint64_t seed) {
  assert(world.actions.size() == policy.actions.size());
  baselines::Learned learned(policy, tables, draw, world.settings.domain, world.settings.border_width);
  std::vector<search::EpisodeRecord> records;
  for (const Flight& flight : fly(learned, world, {.end = episodes}, seed)) records.push_back(flight.record);
  return records;
}

search::SearchSettings search_of(const policy::FrozenPolicy& policy) {
  search::SearchSettings settings;
  settings.domain = {.south_west = {}, .north_east = policy.area_size};
  settings.start_region = settings.domain;
  settings.direction_count = policy.actions.size();
  settings.step_length = policy.step_length;
  settings.detection_threshold = policy.detection_threshold;
  settings.listening = policy.observation.listening;
  return settings;
}

search::World world_of(const policy::FrozenPolicy& policy, const search::SearchSettings& settings, const sonar::SnrCurve& curve) {
  assert(settings.direction_count == policy.actions.size());
  search::World world(settings, curve);
  world.actions = policy.actions;
  return world;
}

Summary summarise(std::span<const search::EpisodeRecord> records) {
  assert(!records.empty());
  const auto count = static_cast<double>(records.size());
  Summary summary;
  summary.episodes = records.size();
  std::vector<double> rewards;
  for (const search::EpisodeRecord& record : records) {  // sums first: shares of whole numbers come out exact
    rewards.push_back(record.reward);
    summary.mean_reward += record.reward;
    summary.found += record.end == search::EpisodeEnd::kFound ? 1 : 0;
    summary.left_domain_fraction += record.end == search::EpisodeEnd::kLeftDomain ? 1.0 : 0.0;
    summary.mean_steps += record.steps;
    summary.mean_detections += record.detections;
  }
  for (double* mean : {&summary.mean_reward, &summary.left_domain_fraction, &summary.mean_steps, &summary.mean_detections}) *mean /= count;
  summary.found_fraction = static_cast<double>(summary.found) / count;
  summary.lower_quartile_reward = quantile(rewards, 0.25);
  summary.median_reward = quantile(rewards, 0.5);
  summary.upper_quartile_reward = quantile(rewards, 0.75);
  return summary;
}

std::optional<DeclarationShares> declaration_shares(std::span<const Flight> flights) {
  if (flights.empty() || !flights.front().declarations) return std::nullopt;
  DeclarationShares shares;
  double within = 0.0;
  for (const Flight& flight : flights) {
    const Declarations& declared = *flight.declarations;
    within += declared.was_within ? 1.0 : 0.0;
    shares.missed += declared.was_within && !declared.rightly ? 1.0 : 0.0;
    shares.falsely += declared.falsely ? 1.0 : 0.0;
    shares.far_off += declared.far_off ? 1.0 : 0.0;
  }
  shares.falsely /= static_cast<double>(flights.size());
  shares.far_off /= static_cast<double>(flights.size());
  shares.missed = within > 0.0 ? shares.missed / within : std::numeric_limits<double>::quiet_NaN();
  return shares;
}

double path_over_straight(std::span<const Flight> flights) {
  double path_m = 0.0;
  double straight_m = 0.0;
  for (const Flight& flight : flights) {
    if (flight.record.end != search::EpisodeEnd::kFound) continue;
    path_m += flight.path_m;
    straight_m += flight.straight_m;
  }
  return straight_m > 0.0 ? path_m / straight_m : std::numeric_limits<double>::quiet_NaN();
}

Mismatches mismatches(std::span<const Flight> flights) {
  std::vector<double> measurements;
  double judged = 0.0;
  for (const Flight& flight : flights) {
    if (std::isfinite(flight.measurements_to_mismatch)) measurements.push_back(flight.measurements_to_mismatch);
    judged += std::isnan(flight.measurements_to_mismatch) ? 0.0 : 1.0;
  }
  Mismatches result;
  if (judged > 0.0) result.fraction = static_cast<double>(measurements.size()) / judged;
  if (!measurements.empty()) result.median_measurement = quantile(std::move(measurements), 0.5);
  return result;
}

double decision_time_s(std::span<const Flight> flights) {
  return mean_over_decisions(flights, &Flight::decision_s);
}

double refinement_time_s(std::span<const Flight> flights) {
  return mean_over_decisions(flights, &Flight::refinement_s);
}

double quantile(std::vector<double> values, double q) {
  assert(!values.empty() && q >= 0.0 && q <= 1.0);
  std::ranges::sort(values);
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace earshot::evaluate
