#include "policy/python/world.hpp"

#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/search_description.hpp"
#include "policy/description/state.hpp"
#include "sim/ocean/file/environment_file.hpp"

namespace earshot::python {
namespace {

using host::BadInput;

/// Which of two words it is: true for the first.
bool is_first(const char* name, const std::string& word, const char* first, const char* second) {
  if (word == first || word == second) return word == first;
  throw BadInput(std::string(name) + " = \"" + word + "\": must be \"" + first + "\" or \"" + second + "\"");
}

search::SearchSettings settings_of(const WorldArguments& arguments, NorthEast source) {
  search::SearchSettings settings;
  settings.source = source;
  settings.placement =
      is_first("source", arguments.source, "fixed", "changing") ? search::SourcePlacement::kFixed : search::SourcePlacement::kChanging;
  settings.direction_count = arguments.direction_count;
  settings.border_width = arguments.border_width;
  settings.max_steps = arguments.max_steps;
  try {
    settings.listening = host::listening_window(arguments.listening, arguments.listening_window_s);
  } catch (const BadInput& e) {
    throw BadInput(std::string("listening, listening_window_s: ") + e.what());
  }
  if (!is_first("start", arguments.start, "domain", "inside_border")) settings.start_region = search::inside_border(settings);
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

description::State state_of(const WorldArguments& arguments) {
  const std::optional<description::State> state = description::state_named(arguments.state);
  if (!state) throw BadInput("state = \"" + arguments.state + "\": must be \"simple\", \"memory\", \"belief\" or \"position_memory\"");
  const std::size_t most = description::most_remembered(*state);
  if (description::remembers(*state) && (arguments.remembered_steps < 1 || arguments.remembered_steps > most)) {
    throw BadInput("remembered_steps = " + std::to_string(arguments.remembered_steps) + ": must be 1 to " + std::to_string(most));
  }
  return *state;
}

description::SearchDescription description_of(const WorldArguments& arguments, const search::SearchSettings& settings,
                                              const policy::ObservationModel& observation, std::uint32_t environment_crc32) {
  description::SearchDescription description = description::describe(settings, observation);
  description.provenance = {{"environment", arguments.environment.filename().string()},
                            {"environment_crc32", host::crc32_text(environment_crc32)},
                            {"state", arguments.state},
                            {"source", arguments.source},
                            {"start", arguments.start}};
  return description;
}

}  // namespace

World::World(const WorldArguments& arguments) {
  const ocean::Environment environment = ocean::load_environment(arguments.environment);
  if (!(arguments.vehicle_depth.value > 0.0 && arguments.vehicle_depth < environment.seabed.depth)) {
    throw BadInput("vehicle_depth_m: must be above 0 and less than the depth of the sea floor");
  }
  const search::SearchSettings settings = settings_of(arguments, environment.source.position);
  const description::State state = state_of(arguments);
  soundscape_ =
      std::make_unique<search::Soundscape>(search::soundscape_of(environment, arguments.vehicle_depth, search::furthest_range(settings)));
  observation_ = description::observation_of(state, arguments.remembered_steps, settings, soundscape_->expected());
  search_ = std::make_unique<search::SearchWorld>(settings, *soundscape_, environment.conditions);
  description_ = description::to_text(description_of(arguments, settings, observation_, environment.file_crc32));
}

}  // namespace earshot::python
