#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "policy/evaluate/candidates.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/parallel/ranks.hpp"
#include "sim/search/scenario/world.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::evaluate {

/// A world as it is searched, and what is taken for granted of it.
struct SearchedWorld {
  search::World world;           ///< assembled of the file's scenario
  sonar::SnrCurve expected;      ///< in the ocean that baselines go by: a vehicle knows how deep it is and what it listens for
  policy::OceanTables own = {};  ///< that ocean as the only one that is believed possible
};

/// Solves the oceans. @param file  says how deep the vehicle is  @param believed  the ocean that baselines go by
[[nodiscard]] std::unique_ptr<SearchedWorld> searched_world(const WorldFile& file, const search::SearchSettings& settings,
                                                            const ocean::Environment& believed);

/// What every candidate meets in one world.
struct Trial {
  const WorldFile& file;
  const SearchedWorld& searched;
  const policy::OceanTables& oceans;  ///< that are believed possible by all who are told none
  std::size_t episodes;
  std::optional<policy::ActionDraw> draw;  ///< instead of each learned candidate's own
};

/// Flies a candidate's searches, shared out among the ranks.
/// @param watcher  sees those of this rank
/// @return on rank 0 the flights in the order of their episodes; elsewhere nothing
[[nodiscard]] std::vector<Flight> fly(const Candidate& candidate, const Trial& trial, parallel::Ranks& ranks, const Watcher& watcher);

}  // namespace earshot::evaluate
