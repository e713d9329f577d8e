#include "policy/evaluate/trial.hpp"

#include <memory>
#include <span>

#include "policy/baselines/catalogue.hpp"
#include "policy/baselines/learned.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::evaluate {
namespace {

/// The flights of this rank: every ranks.size()-th search.
std::vector<Flight> fly_share(const Candidate& candidate, const Trial& trial, const parallel::Ranks& ranks, const Watcher& watcher) {
  search::SearchSettings settings = trial.searched.world.settings;
  if (candidate.learned) settings.direction_count = candidate.learned->actions.size();
  search::World world(settings, trial.searched.world.soundscape, trial.searched.world.conditions);
  if (candidate.learned) world.actions = candidate.learned->actions;
  const baselines::PriorKnowledge prior{
      .settings = settings, .actions = world.actions, .snr = trial.searched.expected, .oceans = trial.oceans};
  std::unique_ptr<baselines::Searcher> searcher;
  if (candidate.learned) {
    searcher = std::make_unique<baselines::Learned>(*candidate.learned, trial.oceans, trial.draw.value_or(candidate.learned->draw),
                                                    settings.domain, settings.border_width);
  } else {
    searcher = candidate.make ? candidate.make(prior) : baselines::make_baseline(candidate.name, prior);
  }
  if (!searcher->declares_found()) world.settings.found_by = search::FoundBy::kSimulator;  // else it would never find
  return fly(*searcher, world, {.end = trial.episodes, .first = ranks.rank(), .stride = ranks.size()}, trial.file.seed, watcher);
}

}  // namespace

std::unique_ptr<SearchedWorld> searched_world(const WorldFile& file, const search::SearchSettings& settings,
                                              const ocean::Environment& believed) {
  const Meters depth = file.vehicle_depth.value();
  ocean::Environment expected = believed;
  expected.source.frequency = file.scenario.environment.source.frequency;
  auto searched = std::make_unique<SearchedWorld>(
      SearchedWorld{.world = search::assemble(file.scenario, settings, depth),
                    .expected = sonar::compute_snr_curve(expected, depth, search::furthest_range(settings))});
  search::make_known_ocean(settings, searched->expected, searched->own);
  return searched;
}

std::vector<Flight> fly(const Candidate& candidate, const Trial& trial, parallel::Ranks& ranks, const Watcher& watcher) {
  const std::vector<Flight> mine = fly_share(candidate, trial, ranks, watcher);
  const auto shares = parallel::gather_values(ranks, std::span(mine));
  std::vector<Flight> all(shares.empty() ? 0 : trial.episodes);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = shares[i % shares.size()][i / shares.size()];
  return all;
}

}  // namespace earshot::evaluate
