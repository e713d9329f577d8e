#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "policy/evaluate/output/searches_json.hpp"
#include "policy/evaluate/output/table.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/search/settings.hpp"

namespace earshot::evaluate {

/// The ocean tables that were searched by in a world.
struct FlownTables {
  std::string file;
  std::string sha256;     ///< of its bytes
  std::size_t count;      ///< of its tables
  std::string signed_by;  ///< public key, hexadecimal; empty: its signature does not hold
};

/// What was evaluated: the searches and their worlds.
struct EvaluationSetup {
  std::size_t episodes;                  ///< in each world
  std::optional<double> start_margin_m;  ///< of the starts from every edge
  std::string start;                     ///< name of the region of the starts; where there is no margin
  const search::SearchSettings& settings;
  Meters vehicle_depth;                   ///< where a world does not say it
  std::string trained_by;                 ///< name of the policy whose training says what no option does; empty: nobody's
  std::span<const std::string> warnings;  ///< of policies that are tested otherwise than they were trained, of worlds without tables, ...
  std::span<const WorldFile> worlds;
  std::span<const std::optional<FlownTables>> tables;  ///< of every world; nothing: the environment's own ocean alone is believed possible
};

/// "300 searches each in munk_flat, source changing"
[[nodiscard]] std::string title_of(const EvaluationSetup& setup);

/// The figures as JSON: the evaluation, then a row for each policy in each world. A time that never comes and an unknown ratio are NaN,
/// which JSON writes as null.
[[nodiscard]] nlohmann::ordered_json figures(const EvaluationSetup& setup, std::span<const Row> rows, Timing timing);
[[nodiscard]] std::string as_json(const EvaluationSetup& setup, std::span<const Row> rows, Timing timing);

/// What the page of an evaluation is given (policy/report/page/source/suite.ts).
[[nodiscard]] std::string as_suite(const EvaluationSetup& setup, std::span<const Row> rows, const SearchesJson& searches);

}  // namespace earshot::evaluate
