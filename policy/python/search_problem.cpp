#include "policy/python/search_problem.hpp"

#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/search_description.hpp"
#include "policy/description/state.hpp"
#include "policy/description/trained_task.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/search/scenario/placement.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::python {
namespace {

using host::BadInput;

/// Throws where a word is none of the two.
template <class Placement>
Placement required(const std::optional<Placement>& placement, const char* name, const std::string& word,
                   const std::array<std::string_view, 2>& names) {
  if (placement) return *placement;
  throw BadInput(std::string(name) + " = \"" + word + "\": must be \"" + std::string(names[0]) + "\" or \"" + std::string(names[1]) + "\"");
}

search::SearchSettings settings_of(const SearchProblemArguments& arguments, NorthEast source) {
  search::SearchSettings settings;
  settings.source = source;
  settings.placement = required(search::placement_named(arguments.source), "source", arguments.source, search::kPlacements);
  settings.direction_count = arguments.direction_count;
  settings.border_width = arguments.border_width;
  settings.max_steps = arguments.max_steps;
  try {
    settings.listening = host::listening_window(arguments.listening, arguments.listening_window_s);
  } catch (const BadInput& e) {
    throw BadInput(std::string("listening, listening_window_s: ") + e.what());
  }
  const auto start = required(search::start_placement_named(arguments.start), "start", arguments.start, search::kStartPlacements);
  settings.start_region = search::start_region_of(settings, start);
  if (settings.direction_count < 1 || settings.direction_count > config::kMaxActions) {
    throw BadInput("directions = " + std::to_string(settings.direction_count) + ": must be 1 to " + std::to_string(config::kMaxActions));
  }
  if (settings.max_steps < 1) throw BadInput("max_steps = 0: must be 1 or more");
  if (!(settings.border_width.value > 0.0)) throw BadInput("border_width_m: must be above 0");
  if (search::check(settings) != Status::kOk) {
    throw BadInput("border_width_m, start: nothing of the domain is left to start in, or all of it lies within a step of the source");
  }
  return settings;
}

description::State state_of(const SearchProblemArguments& arguments) {
  const std::optional<description::State> state = description::state_named(arguments.state);
  if (!state) throw BadInput("state = \"" + arguments.state + "\": must be \"simple\", \"memory\", \"belief\" or \"position_memory\"");
  const std::size_t most = description::most_remembered(*state);
  if (description::remembers(*state) && (arguments.remembered_steps < 1 || arguments.remembered_steps > most)) {
    throw BadInput("remembered_steps = " + std::to_string(arguments.remembered_steps) + ": must be 1 to " + std::to_string(most));
  }
  return *state;
}

description::SearchDescription description_of(const SearchProblemArguments& arguments, const search::SearchSettings& settings,
                                              const policy::ObservationModel& observation, std::uint32_t environment_crc32) {
  description::SearchDescription description = description::describe(settings, observation);
  description.provenance = {{"environment", arguments.environment.filename().string()},
                            {"environment_crc32", host::crc32_text(environment_crc32)},
                            {"state", arguments.state}};
  for (auto& line : description::task_lines(settings, arguments.vehicle_depth)) description.provenance.push_back(std::move(line));
  return description;
}

}  // namespace

std::uint32_t environment_crc32(const std::filesystem::path& environment) {
  return search::load_scenario(environment).environment.file_crc32;
}

SearchProblem::SearchProblem(const SearchProblemArguments& arguments) : arguments_(arguments) {
  const search::Scenario scenario = search::load_scenario(arguments.environment);
  const ocean::Environment& environment = scenario.environment;
  environment_crc32_ = environment.file_crc32;
  if (!(arguments.vehicle_depth.value > 0.0 && arguments.vehicle_depth < environment.seabed.depth)) {
    throw BadInput("vehicle_depth_m: must be above 0 and less than the depth of the sea floor");
  }
  const search::SearchSettings settings = settings_of(arguments, environment.source.position);
  const description::State state = state_of(arguments);
  world_ = std::make_unique<search::World>(search::assemble(scenario, settings, arguments.vehicle_depth));
  observation_ = description::observation_of(state, arguments.remembered_steps, settings);
  search::make_known_ocean(settings, world_->expected(), tables_);
  description_ = description::to_text(description_of(arguments, settings, observation_, environment.file_crc32));
}

}  // namespace earshot::python
