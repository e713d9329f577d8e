#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"
#include "policy/baselines/searcher.hpp"
#include "sim/search/episode/episode.hpp"

namespace earshot::evaluate {

/// What a searcher said that says itself whether the source is found.
struct Declarations {
  bool was_within = false;  ///< l of a source, at the end of a step
  bool rightly = false;     ///< said there that it is found
  bool falsely = false;     ///< said so elsewhere
  bool far_off = false;     ///< said so further than 1.5 l from every source
};

/// One search as it went.
struct Flight {
  search::EpisodeRecord record;
  double path_m = 0.0;                                      ///< over ground
  double straight_m = 0.0;                                  ///< from the start to within l of where the nearest source then was
  double decision_s = 0.0;                                  ///< by the clock, all decisions together
  double refinement_s = 0.0;                                ///< by the clock, on the way from one decision to the next
  std::optional<Declarations> declarations = std::nullopt;  ///< of searchers that make any
  /// Measurements (the start's, and one after every step that did not end the search) up to the first that was a mismatch to the searcher;
  /// infinite: none did; NaN: it does not judge that.
  double measurements_to_mismatch = std::numeric_limits<double>::quiet_NaN();
};

/// Which episodes of a seed are flown: every stride-th from the first, below the end.
struct Episodes {
  std::size_t end;
  std::size_t first = 0;
  std::size_t stride = 1;
};

/// Shown every episode at its start and after each of its steps, and how the search stands then: one that its searcher rightly declares
/// found has ended, which the episode itself does not know (SearchSettings::found_by).
using Watcher = std::function<void(std::size_t number, const search::Episode& episode, search::EpisodeEnd end)>;

/// Episode i draws its start, its sources and all that its world's conditions ask for from stream 2i of the seed's for evaluation
/// (sim/search/streams.hpp), what the searcher draws from stream 2i + 1: the same starts for every searcher, and none that a training drew.
/// Where a searcher says itself that the source is found (SearchSettings::found_by) a search ends when it does so within l of a source.
/// Oracle: EvaluateTest.FliesNoSearchThatATrainingOfTheSameSeedBeginsWith
[[nodiscard]] std::vector<Flight> fly(baselines::Searcher& searcher, const search::World& world, Episodes episodes, std::uint64_t seed,
                                      const Watcher& watcher = {});

/// Flies `episodes` searches with the arithmetic that flies at sea (firmware/policy); `world.actions` are the policy's.
/// @param tables  of the oceans that are believed possible
[[nodiscard]] std::vector<search::EpisodeRecord> evaluate(const policy::FrozenPolicy& policy, const policy::OceanTables& tables,
                                                          policy::ActionDraw draw, const search::World& world, std::size_t episodes,
                                                          std::uint64_t seed);

/// The search a policy was trained for: a domain of its area's size with the south-west corner at the origin, its step length, number of
/// directions and detection threshold; starts anywhere in the domain, the rest as the paper has it.
[[nodiscard]] search::SearchSettings search_of(const policy::FrozenPolicy& policy);

/// The world a policy is evaluated in: `settings` with the policy's own directions.
/// @param settings  settings.direction_count is the number of the policy's actions
[[nodiscard]] search::World world_of(const policy::FrozenPolicy& policy, const search::SearchSettings& settings,
                                     const sonar::SnrCurve& curve);

struct Summary {
  std::size_t episodes = 0;
  std::size_t found = 0;
  double mean_reward = 0.0;
  double lower_quartile_reward = 0.0;
  double median_reward = 0.0;
  double upper_quartile_reward = 0.0;
  double found_fraction = 0.0;  ///< 0 to 1
  double left_domain_fraction = 0.0;
  double mean_steps = 0.0;
  double mean_detections = 0.0;
};

/// How often those that say themselves whether the source is found were wrong.
struct DeclarationShares {
  double falsely = 0.0;  ///< of all searches: those in which it was declared found further than l from every source
  double far_off = 0.0;  ///< and those further than 1.5 l
  double missed = 0.0;   ///< of the searches that came within l of a source at the end of a step: those in which it was not declared there
};

/// Nothing where there were no such searchers. @param flights  of one searcher
[[nodiscard]] std::optional<DeclarationShares> declaration_shares(std::span<const Flight> flights);

/// @param records  at least one
[[nodiscard]] Summary summarise(std::span<const search::EpisodeRecord> records);

/// Length of the paths over that of the straight lines, of the searches that found a source: the sum of the one over the sum of the other,
/// so that a start a few metres out of reach, to which any detour is long, weighs no more than it should. NaN when none found one.
[[nodiscard]] double path_over_straight(std::span<const Flight> flights);

/// How many searches met what the searcher's belief does not explain.
struct Mismatches {
  double fraction = std::numeric_limits<double>::quiet_NaN();            ///< of all searches; NaN: the searcher does not judge that
  double median_measurement = std::numeric_limits<double>::quiet_NaN();  ///< of those with a mismatch, the measurement of it; NaN: none was
};

[[nodiscard]] Mismatches mismatches(std::span<const Flight> flights);

/// Mean over all decisions, seconds: what a vehicle waits for.
[[nodiscard]] double decision_time_s(std::span<const Flight> flights);

/// Mean over all decisions of what follows each, seconds: what a vehicle weighs on its way.
[[nodiscard]] double refinement_time_s(std::span<const Flight> flights);

/// The q-quantile (0 to 1) by linear interpolation between order statistics, as NumPy's default. @param values  at least one, any order
[[nodiscard]] double quantile(std::vector<double> values, double q);

}  // namespace earshot::evaluate
