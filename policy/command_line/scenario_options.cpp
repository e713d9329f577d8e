#include "policy/command_line/scenario_options.hpp"

#include <sstream>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/scenario/placement.hpp"
#include "sim/search/scenario/scenario_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::command_line {

using host::BadInput;

void ScenarioOptions::add_to(program::CommandLine& line, const Otherwise& otherwise) {
  line.option("--environment", &environment,
              "environment file (TOML): ocean, source and noise, such as sim/ocean/environments/munk_flat.toml");
  line.option("--vehicle-depth-m", &vehicle_depth_m, "depth of the vehicle, metres (300)").positive();
  line.option(
          "--source", &source,
          "source: fixed where the environment puts it, or changing, uniform in the domain anew every episode (" + otherwise.source + ")")
      .one_of({search::kPlacements.begin(), search::kPlacements.end()});
  line.option("--start", &start,
              "vehicle starts uniformly in the domain, or inside_border, where the border costs nothing (" + otherwise.start + ")")
      .one_of({search::kStartPlacements.begin(), search::kStartPlacements.end()});
  line.option("--start-margin-m", &start_margin_m, "vehicle starts uniformly at least so far from every edge, metres; instead of --start")
      .not_negative()
      .excludes(line.at("--start"));
  line.option("--border-width-m", &border_width_m, "width b of the border in which the reward falls to -100, metres (1000)").positive();
  line.option("--max-steps", &max_steps, "N, steps after which an episode is cut (100)").from(1, 1'000'000);
  listening.add_to(line, otherwise.listening);
}

void apply_choices(const description::SearchChoices& choices, search::SearchSettings& settings) {
  if (!description::apply(choices, settings)) {
    throw BadInput(
        "--border-width-m, --start, --start-margin-m: nothing of the domain is left to start in, or all of it lies within a step of the "
        "source");
  }
}

void ScenarioOptions::apply_to(search::SearchSettings& settings) const {
  apply_choices(*this, settings);
  if (listening.is_given()) settings.listening = listening.applied_to(settings.listening);
}

search::Scenario scenario_at(const std::filesystem::path& path, Meters vehicle_depth) {
  if (path.empty()) throw BadInput("--environment: no environment file given");
  search::Scenario scenario = search::load_scenario(path, "--environment");
  check_vehicle_depth(scenario.environment, path, vehicle_depth);
  return scenario;
}

void check_vehicle_depth(const ocean::Environment& environment, const std::filesystem::path& path, Meters vehicle_depth) {
  if (vehicle_depth < environment.seabed.depth) return;
  std::ostringstream text;
  text << "--vehicle-depth-m " << vehicle_depth.value << ": must be less than " << environment.seabed.depth.value
       << " m, the depth of the sea floor in " << path.string();
  throw BadInput(text.str());
}

sonar::SnrCurve curve_for(const ocean::Environment& environment, Meters vehicle_depth, const search::SearchSettings& settings) {
  return sonar::compute_snr_curve(environment, vehicle_depth, search::furthest_range(settings));
}

}  // namespace earshot::command_line
