#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/policy/observation.hpp"
#include "policy/description/element_names.hpp"
#include "sim/search/episode/episode.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::python {

/// What a person may choose about the search; the defaults stand in earshot_gym/environment.py.
struct SearchProblemArguments {
  std::filesystem::path environment;
  std::string state;
  std::size_t remembered_steps = 0;
  std::string source;
  std::string start;
  std::size_t direction_count = 0;
  Meters vehicle_depth;
  Meters border_width;
  std::uint32_t max_steps = 0;
  std::string listening;
  std::int64_t listening_window_s = 0;
};

/// CRC-32 of an environment file and of all that it names (data files, charts, its other oceans, its field library): another one, another
/// search. Throws host::BadInput.
[[nodiscard]] std::uint32_t environment_crc32(const std::filesystem::path& environment);

/// A search with its ocean solved; shared by every episode that runs in it.
class SearchProblem {
 public:
  /// Solves the ocean: a second or so. Throws host::BadInput.
  explicit SearchProblem(const SearchProblemArguments& arguments);
  SearchProblem(const SearchProblem&) = delete;
  SearchProblem& operator=(const SearchProblem&) = delete;

  [[nodiscard]] const SearchProblemArguments& arguments() const { return arguments_; }
  /// environment_crc32() of what was solved.
  [[nodiscard]] std::uint32_t environment_crc32() const { return environment_crc32_; }
  [[nodiscard]] const search::World& world() const { return *world_; }
  [[nodiscard]] const policy::ObservationModel& observation() const { return observation_; }
  /// The oceans that a belief thinks possible: the environment's alone.
  [[nodiscard]] const policy::OceanTables& tables() const { return tables_; }
  /// A name for each element of an observation.
  [[nodiscard]] std::vector<std::string> observation_names() const { return description::element_names(observation_.spec); }
  /// Text of the search description (policy/description) that travels with a policy's weights.
  [[nodiscard]] const std::string& description() const { return description_; }

 private:
  SearchProblemArguments arguments_;
  std::uint32_t environment_crc32_ = 0;
  std::unique_ptr<search::World> world_;
  policy::ObservationModel observation_;
  policy::OceanTables tables_;
  std::string description_;
};

}  // namespace earshot::python
