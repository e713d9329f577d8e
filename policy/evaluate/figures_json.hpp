#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "policy/evaluate/table.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/search/settings.hpp"

namespace earshot::evaluate {

/// What was evaluated: the searches and their worlds.
struct EvaluationSetup {
  std::size_t episodes;                  ///< in each world
  std::optional<double> start_margin_m;  ///< of the starts from every edge
  std::string start;                     ///< name of the region of the starts; where there is no margin
  const search::SearchSettings& settings;
  std::span<const WorldFile> worlds;
};

/// "300 searches each in munk_flat, source changing"
[[nodiscard]] std::string title_of(const EvaluationSetup& setup);

/// The figures as JSON: the evaluation, then a row for each policy in each world.
[[nodiscard]] std::string as_json(const EvaluationSetup& setup, std::span<const Row> rows, Timing timing);

}  // namespace earshot::evaluate
