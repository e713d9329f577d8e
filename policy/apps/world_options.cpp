#include "policy/apps/world_options.hpp"

#include "firmware/host/toml/table_reader.hpp"
#include "policy/description/placement.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::apps {

using host::BadInput;

void WorldOptions::add_to(program::CommandLine& line, const Otherwise& otherwise) {
  line.option("--environment", &environment,
              "environment file (TOML): ocean, source and noise, such as sim/ocean/environments/munk_flat.toml");
  line.option("--vehicle-depth-m", &vehicle_depth_m, "depth of the vehicle, metres (300)").positive();
  line.option(
          "--source", &source,
          "source: fixed where the environment puts it, or changing, uniform in the domain anew every episode (" + otherwise.source + ")")
      .one_of({description::kPlacements.begin(), description::kPlacements.end()});
  line.option("--start", &start,
              "vehicle starts uniformly in the domain, or inside_border, where the border costs nothing (" + start.value_or("domain") + ")")
      .one_of({"domain", "inside_border"});
  line.option("--start-margin-m", &start_margin_m, "vehicle starts uniformly at least so far from every edge, metres; instead of --start")
      .not_negative()
      .excludes(line.at("--start"));
  line.option("--border-width-m", &border_width_m, "width b of the border in which the reward falls to -100, metres (1000)").positive();
  line.option("--max-steps", &max_steps, "N, steps after which an episode is cut (100)").from(1, 1'000'000);
  listening.add_to(line, otherwise.listening);
}

void WorldOptions::apply_to(search::SearchSettings& settings) const {
  if (source) settings.placement = description::placement_named(*source).value_or(settings.placement);
  if (border_width_m) settings.border_width = Meters{*border_width_m};
  if (max_steps) settings.max_steps = *max_steps;
  if (start) settings.start_region = *start == "domain" ? settings.domain : search::inside_border(settings);
  if (start_margin_m) settings.start_region = settings.domain.moved_in(Meters{*start_margin_m});
  if (listening.is_given()) settings.listening = listening.applied_to(settings.listening);
  if (search::check(settings) != Status::kOk) {
    throw BadInput(
        "--border-width-m, --start, --start-margin-m: nothing of the domain is left to start in, or all of it lies within a step of the "
        "source");
  }
}

ocean::Environment environment_at(const std::filesystem::path& path, Meters vehicle_depth) {
  if (path.empty()) throw BadInput("--environment: no environment file given");
  ocean::Environment environment = ocean::load_environment(path);
  check_vehicle_depth(environment, path, vehicle_depth);
  return environment;
}

void check_vehicle_depth(const ocean::Environment& environment, const std::filesystem::path& path, Meters vehicle_depth) {
  if (vehicle_depth < environment.seabed.depth) return;
  throw BadInput("--vehicle-depth-m: must be less than the depth of the sea floor in " + path.string());
}

sonar::SnrCurve curve_for(const ocean::Environment& environment, Meters vehicle_depth, const search::SearchSettings& settings) {
  return sonar::compute_snr_curve(environment, vehicle_depth, search::furthest_range(settings));
}

search::Soundscape soundscape_for(const ocean::Environment& environment, Meters vehicle_depth, const search::SearchSettings& settings) {
  return search::soundscape_of(environment, vehicle_depth, search::furthest_range(settings));
}

}  // namespace earshot::apps
