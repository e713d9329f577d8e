#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "policy/evaluate/candidates.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/parallel/ranks.hpp"
#include "sim/search/scenario/world.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::evaluate {

/// What every candidate meets in one world.
struct Trial {
  const WorldFile& file;
  const search::World& world;         ///< assembled of the file's scenario
  const sonar::SnrCurve& expected;    ///< SNR against range that baselines take for granted
  const policy::OceanTables* oceans;  ///< other oceans that they believe possible; null: none
  std::size_t episodes;
  std::optional<policy::ActionDraw> draw;  ///< instead of each learned candidate's own
};

/// Flies a candidate's searches, shared out among the ranks.
/// @param watcher  sees those of this rank
/// @return on rank 0 the flights in the order of their episodes; elsewhere nothing
[[nodiscard]] std::vector<Flight> fly(const Candidate& candidate, const Trial& trial, parallel::Ranks& ranks, const Watcher& watcher);

}  // namespace earshot::evaluate
