#include "policy/evaluate/evaluation.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "firmware/policy/network.hpp"

namespace earshot::evaluate {
namespace {

search::EpisodeRecord fly(const policy::FrozenPolicy& policy, policy::ActionDraw draw, const search::SearchWorld& world, Pcg32 starts,
                          Pcg32 actions) {
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
  const std::span<float> seen = std::span(observation).first(policy.observation.spec.size());
  const std::span<float> scores = std::span(logits).first(policy.actions.size());
  search::Episode episode;
  episode.start(world, policy.observation, starts);
  while (episode.record().end == search::EpisodeEnd::kRunning) {
    episode.observe(seen);
    policy::forward(policy.network, seen, scores);
    episode.step(world, policy::draw_action(draw, scores, actions));
  }
  return episode.record();
}

}  // namespace

std::vector<search::EpisodeRecord> evaluate(const policy::FrozenPolicy& policy, policy::ActionDraw draw, const search::SearchWorld& world,
                                            std::size_t episodes, std::uint64_t seed) {
  assert(world.actions.size() == policy.actions.size());
  std::vector<search::EpisodeRecord> records(episodes);
  for (std::size_t i = 0; i < episodes; ++i) records[i] = fly(policy, draw, world, Pcg32(seed, 2 * i), Pcg32(seed, 2 * i + 1));
  return records;
}

search::SearchSettings search_of(const policy::FrozenPolicy& policy) {
  search::SearchSettings settings;
  settings.domain = {.south_west = {}, .north_east = policy.area_size};
  settings.start_region = settings.domain;
  settings.direction_count = policy.actions.size();
  settings.step_length = policy.step_length;
  settings.detection_threshold = policy.detection_threshold;
  return settings;
}

search::SearchWorld world_of(const policy::FrozenPolicy& policy, const search::SearchSettings& settings, const sonar::SnrCurve& curve) {
  assert(settings.direction_count == policy.actions.size());
  search::SearchWorld world(settings, curve);
  world.actions = policy.actions;
  return world;
}

Summary summarise(std::span<const search::EpisodeRecord> records) {
  assert(!records.empty());
  const auto count = static_cast<double>(records.size());
  Summary summary;
  summary.episodes = records.size();
  std::vector<double> rewards;
  for (const search::EpisodeRecord& record : records) {
    rewards.push_back(record.reward);
    summary.mean_reward += record.reward / count;
    summary.found_fraction += record.end == search::EpisodeEnd::kFound ? 1.0 / count : 0.0;
    summary.left_domain_fraction += record.end == search::EpisodeEnd::kLeftDomain ? 1.0 / count : 0.0;
    summary.mean_steps += record.steps / count;
    summary.mean_detections += record.detections / count;
  }
  summary.lower_quartile_reward = quantile(rewards, 0.25);
  summary.median_reward = quantile(rewards, 0.5);
  summary.upper_quartile_reward = quantile(rewards, 0.75);
  return summary;
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
