#include "policy/apps/train_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "firmware/config_file/table_reader.hpp"

namespace earshot::apps {
namespace {

constexpr std::uint64_t kMostSeeds = 1'000;

/// "3", "1-5" or "1,2,7".
std::vector<std::uint64_t> seeds_in(const std::string& text) {
  std::vector<std::uint64_t> seeds;
  const char* at = text.data();
  const char* const end = at + text.size();
  auto number = [&at, end, &text] {
    std::uint64_t value = 0;
    const auto done = std::from_chars(at, end, value);
    if (done.ec != std::errc()) throw CLI::ValidationError("--seeds", "must be like 1-5 or 1,2,7: " + text);
    at = done.ptr;
    return value;
  };
  while (true) {
    const std::uint64_t first = number();
    const std::uint64_t last = at != end && *at == '-' ? (++at, number()) : first;
    if (last < first) throw CLI::ValidationError("--seeds", "must be like 1-5 or 1,2,7: " + text);
    if (last - first >= kMostSeeds - seeds.size())
      throw CLI::ValidationError("--seeds", "more than " + std::to_string(kMostSeeds) + " trainings: " + text);
    for (std::uint64_t i = 0; i <= last - first; ++i) seeds.push_back(first + i);  // last may be the greatest number there is
    if (at == end) break;
    if (*at++ != ',') throw CLI::ValidationError("--seeds", "must be like 1-5 or 1,2,7: " + text);
  }
  std::ranges::sort(seeds);
  if (std::ranges::adjacent_find(seeds) != seeds.end()) throw CLI::ValidationError("--seeds", "a seed twice: " + text);
  return seeds;
}

}  // namespace

void TrainOptions::add_to(CLI::App& app) {
  app.add_option("RUN", run_file, "run file (TOML) with every setting, such as policy/ppo/runs/fixed_source.toml; options override it");
  app.add_option("-o,--output", output, "checkpoint to write (with --resume the one it goes on from)");
  app.add_option("--resume", resume,
                 "checkpoint of a training to go on with, bit for bit, as its own command line said; several go on together")
      ->expected(1, -1);
  app.add_option("--checkpoint-every", checkpoint_every, "steps after which the checkpoint is written again (at the end, and on Ctrl-C)")
      ->check(CLI::PositiveNumber);
  app.add_option("--curve", curve,
                 "learning curve to write, CSV (the checkpoint's name with .csv; with --resume alone where it was); the losses go to "
                 ".updates.csv beside "
                 "it");
  app.add_option("--plot", plot, "picture of the reward in training to write, .png or .svg: median of the last 50 episodes, quartiles");
  app.add_option("--episodes", episodes, "train for so many episodes, in whole rollouts (1500 when neither this nor --steps is given)");
  app.add_option("--steps", steps, "train for so many steps, in whole rollouts");
  world.add_to(app);
  app.add_option(
         "--state", state,
         "what the policy sees: simple (x, y), memory (last steps and their SNR), position_memory (both) or belief (where the source may "
         "be) (simple)")
      ->check(CLI::IsMember({"simple", "memory", "position_memory", "belief"}));
  app.add_option("--remembered-steps", remembered_steps, "m of the memory state (2)")
      ->check(CLI::Range(1, static_cast<int>(config::kMaxRememberedSteps)));
  auto* one_seed = app.add_option("--seed", seed, "seed of everything random (1)");
  app.add_option_function<std::string>(
         "--seeds", [this](const std::string& text) { seeds = seeds_in(text); },
         "train with each of these, 1-5 or 1,2,7, on all processors: FILE.seed1.checkpoint, ...")
      ->excludes(one_seed);
  app.add_option("--threads", threads, "trainings at a time (all processors)")->check(CLI::Range(1, 1024));
  app.add_option("--environments", environments, "episodes stepped together (1)")->check(CLI::Range(1, 65'536));
}

void check_for_resume(const CLI::App& app) {
  constexpr std::array<std::string_view, 9> kFree{"--resume",   "--output", "--checkpoint-every", "--curve", "--plot",
                                                  "--episodes", "--steps",  "--threads",          "--help"};
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const bool free = std::ranges::any_of(kFree, [&](std::string_view each) { return option->check_name(std::string(each)); });
    if (option->count() > 0 && !free) throw config_file::BadInput(name + ": stays as it was in a training that --resume goes on with");
  }
}

void TrainOptions::resolve(const std::filesystem::path& directory) {
  for (auto* path : {&run_file, &world.environment}) {
    if (*path) *path = (directory / **path).string();
  }
}

TrainOptions options_from(const std::vector<std::string>& arguments) {
  TrainOptions options;
  CLI::App app;
  options.add_to(app);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
  app.parse(reversed);
  return options;
}

ppo::TrainingRun settled(const TrainOptions& options) {
  ppo::TrainingRun run = options.run_file ? ppo::load_run(*options.run_file) : ppo::TrainingRun{};
  if (options.world.environment) run.environment = *options.world.environment;
  if (options.world.vehicle_depth_m) run.vehicle_depth = Meters{*options.world.vehicle_depth_m};
  if (options.state) run.state = description::state_named(*options.state).value();
  if (options.remembered_steps) run.remembered_steps = *options.remembered_steps;
  if (const std::size_t most = description::most_remembered(run.state); run.remembered_steps > most) {
    throw config_file::BadInput("--remembered-steps, remembered_steps: at most " + std::to_string(most) + " with the state " +
                                std::string(description::name_of(run.state)));
  }
  if (options.seed) run.seed = *options.seed;
  if (options.environments) run.hyper.environment_count = *options.environments;
  if (options.episodes || options.steps) {
    run.episodes = options.episodes.value_or(0);
    run.steps = options.steps.value_or(0);
  }
  if (run.episodes == 0 && run.steps == 0) run.episodes = 1'500;
  if (run.learning_rate_schedule == ppo::LearningRateSchedule::kLinear) {
    if (run.steps == 0)
      throw config_file::BadInput(*options.run_file + ": ppo.learning_rate_schedule = \"linear\": needs steps, at which the rate is zero");
    run.hyper.decay_steps = run.steps;
  }
  return run;
}

}  // namespace earshot::apps
