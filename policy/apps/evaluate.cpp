#include "policy/evaluate/evaluation.hpp"

#include <chrono>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "policy/apps/program.hpp"
#include "policy/apps/world_options.hpp"
#include "policy/evaluate/policy_file.hpp"

namespace {

using namespace earshot;

struct Options {
  std::string policy;
  apps::WorldOptions world;
  std::size_t episodes = 300;
  std::uint64_t seed = 1;
  std::optional<std::string> draw;
  std::optional<std::string> json;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("POLICY", options.policy, "frozen policy (.policy)")->required();
  options.world.add_to(app);
  app.add_option("--episodes", options.episodes, "searches to fly")->capture_default_str()->check(CLI::Range(1, 100'000'000));
  app.add_option("--seed", options.seed, "seed of starts, sources and sampled actions")->capture_default_str();
  app.add_option("--draw", options.draw, "how actions are drawn, instead of the policy's own way")
      ->check(CLI::IsMember({"argmax", "sampled"}));
  app.add_option("--json", options.json, "also write the figures there");
}

std::string in_words(policy::ActionDraw draw) {
  return draw == policy::ActionDraw::kArgmax ? "argmax" : "sampled";
}

std::string as_json(const Options& options, policy::ActionDraw draw, const evaluate::Summary& s) {
  nlohmann::ordered_json json;
  json["policy"] = options.policy;
  json["draw"] = in_words(draw);
  json["seed"] = options.seed;
  json["episodes"] = s.episodes;
  json["mean_reward"] = s.mean_reward;
  json["lower_quartile_reward"] = s.lower_quartile_reward;
  json["median_reward"] = s.median_reward;
  json["upper_quartile_reward"] = s.upper_quartile_reward;
  json["found_fraction"] = s.found_fraction;
  json["left_domain_fraction"] = s.left_domain_fraction;
  json["mean_steps"] = s.mean_steps;
  json["mean_detections"] = s.mean_detections;
  return json.dump(1) + "\n";
}

void print(const evaluate::Summary& s, policy::ActionDraw draw) {
  std::printf("%zu episodes, actions %s\n", s.episodes, in_words(draw).c_str());
  std::printf("reward      mean %.2f, median %.2f, quartiles %.2f to %.2f\n", s.mean_reward, s.median_reward, s.lower_quartile_reward,
              s.upper_quartile_reward);
  std::printf("found       %.1f %% (left the domain %.1f %%)\n", 100.0 * s.found_fraction, 100.0 * s.left_domain_fraction);
  std::printf("steps       mean %.1f\n", s.mean_steps);
  std::printf("detections  mean %.1f\n", s.mean_detections);
}

void evaluate_policy(const Options& options) {
  const std::unique_ptr<policy::FrozenPolicy> policy = evaluate::load_policy(options.policy);
  const Meters depth{options.world.vehicle_depth_m.value_or(300.0)};
  const ocean::Environment environment = apps::environment_at(options.world.environment.value_or(""), depth);
  if (options.json) apps::check_writable(*options.json);
  search::SearchSettings settings = evaluate::search_of(*policy);
  settings.source = environment.source.position;
  options.world.apply_to(settings);
  const sonar::SnrCurve curve = apps::curve_for(environment, depth, settings);
  const search::SearchWorld world = evaluate::world_of(*policy, settings, curve);
  const policy::ActionDraw draw = !options.draw               ? policy->draw
                                  : *options.draw == "argmax" ? policy::ActionDraw::kArgmax
                                                              : policy::ActionDraw::kSampled;
  const evaluate::Summary summary = evaluate::summarise(evaluate::evaluate(*policy, draw, world, options.episodes, options.seed));
  print(summary, draw);
  if (options.json) apps::write_whole(*options.json, as_json(options, draw, summary));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Flies many simulated searches with a frozen policy and says how it did.", "earshot evaluate");
  app.footer("Example: earshot evaluate policy/frozen/fixed_source.policy --environment sim/ocean/environments/munk_flat.toml");
  Options options;
  add_options(app, options);
  return apps::run_program(app, argc, argv, [&] { evaluate_policy(options); });
}
