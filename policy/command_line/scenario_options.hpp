#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "firmware/host/program/command_line.hpp"
#include "policy/command_line/listening_options.hpp"
#include "policy/description/search_choices.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/search/scenario/scenario.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::command_line {

/// The part of a command line that says where a policy searches; what is not given leaves the settings as they are.
struct ScenarioOptions : description::SearchChoices {
  std::optional<std::string> environment = {};
  ListeningOptions listening = {};

  /// What help says holds where an option is not given.
  struct Otherwise {
    std::string source;
    std::string start;
    std::string listening;
  };
  void add_to(program::CommandLine& line, const Otherwise& otherwise);
  /// Throws host::BadInput when the settings contradict each other.
  void apply_to(search::SearchSettings& settings) const;
};

/// Settings as chosen, but for the vehicle's depth. Throws host::BadInput, naming the options, when the choices contradict each other.
void apply_choices(const description::SearchChoices& choices, search::SearchSettings& settings);

/// Throws host::BadInput when there is no environment file, or the vehicle's depth is not in its water.
[[nodiscard]] search::Scenario scenario_at(const std::filesystem::path& path, Meters vehicle_depth);

/// Throws host::BadInput when the vehicle's depth is not in the water of the environment read from `path`.
void check_vehicle_depth(const ocean::Environment& environment, const std::filesystem::path& path, Meters vehicle_depth);

/// SNR against range out to search::furthest_range.
[[nodiscard]] sonar::SnrCurve curve_for(const ocean::Environment& environment, Meters vehicle_depth,
                                        const search::SearchSettings& settings);

}  // namespace earshot::command_line
