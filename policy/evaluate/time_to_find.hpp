#pragma once

#include <cstdint>
#include <span>

#include "sim/search/episode/episode.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::evaluate {

/// How fast and how long searches go.
struct Pace {
  double step_s = 500.0;          ///< what a step lasts: its length by the vehicle's speed through the water
  std::uint32_t max_steps = 100;  ///< N, after which a search ends
};

[[nodiscard]] Pace pace_of(const search::World& world);

/// Time to find, steps, over all searches. One that did not find, whether its steps ran out or it left the domain, never does: were only
/// those counted that found, a policy that gives up wherever it is hard would seem the fastest.
struct TimeToFind {
  /// A q-quantile is the number of steps by whose end a share q of all searches has found; infinite where fewer ever did.
  double lower_quartile = 0.0;
  double median = 0.0;
  double upper_quartile = 0.0;
  /// Mean of min(time, N): a search that did not find counts as N steps, wherever it ended. Finite, whatever the share found, and moved by
  /// both: the mean time that a vehicle that searches for N steps at most is without the source.
  double restricted_mean = 0.0;
};

/// What a search counts for in the restricted mean, steps.
[[nodiscard]] double restricted_steps(const search::EpisodeRecord& record, std::uint32_t max_steps);

/// @param records    at least one
/// @param max_steps  N of all of them
/// Source: quantiles of the empirical distribution function; restricted mean: Royston and Parmar, BMC Med. Res. Methodol. 13 (2013) 152.
/// Oracle: TimeToFind.*
[[nodiscard]] TimeToFind time_to_find(std::span<const search::EpisodeRecord> records, std::uint32_t max_steps);

}  // namespace earshot::evaluate
