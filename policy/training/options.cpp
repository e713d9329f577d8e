#include "policy/training/options.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/command_line/outputs.hpp"

namespace earshot::training {
namespace {

using host::BadInput;

constexpr std::uint64_t kMostSeeds = 1'000;

/// "3", "1-5" or "1,2,7".
std::vector<std::uint64_t> seeds_in(const std::string& text) {
  std::vector<std::uint64_t> seeds;
  const char* at = text.data();
  const char* const end = at + text.size();
  auto number = [&at, end, &text] {
    std::uint64_t value = 0;
    const auto done = std::from_chars(at, end, value);
    if (done.ec != std::errc()) throw BadInput("--seeds: must be like 1-5 or 1,2,7: " + text);
    at = done.ptr;
    return value;
  };
  while (true) {
    const std::uint64_t first = number();
    const std::uint64_t last = at != end && *at == '-' ? (++at, number()) : first;
    if (last < first) throw BadInput("--seeds: must be like 1-5 or 1,2,7: " + text);
    if (last - first >= kMostSeeds - seeds.size())
      throw BadInput("--seeds: more than " + std::to_string(kMostSeeds) + " trainings: " + text);
    for (std::uint64_t i = 0; i <= last - first; ++i) seeds.push_back(first + i);  // last may be the greatest number there is
    if (at == end) break;
    if (*at++ != ',') throw BadInput("--seeds: must be like 1-5 or 1,2,7: " + text);
  }
  std::ranges::sort(seeds);
  if (std::ranges::adjacent_find(seeds) != seeds.end()) throw BadInput("--seeds: a seed twice: " + text);
  return seeds;
}

}  // namespace

void TrainOptions::add_to(program::CommandLine& line) {
  line.option("RUN", &run_file, "run file (TOML) with every setting, such as policy/ppo/runs/fixed_source.toml; options override it");
  line.option("-o,--output", &output, "checkpoint to write (with --resume the one it goes on from)");
  line.option("--resume", &resume,
              "checkpoint of a training to go on with, bit for bit, as its own command line asked; several go on together")
      .takes(1, -1);
  line.option("--checkpoint-every", &checkpoint_every, "steps after which the checkpoint is written again (at the end, and on Ctrl-C)")
      .positive();
  line.option("--curve", &curve,
              "learning curve to write, CSV (the checkpoint's name with .csv; with --resume alone where it was); the losses go to "
              ".updates.csv beside "
              "it");
  line.option("--plot", &plot, "picture of the reward in training to write, .png or .svg: median of the last 50 episodes, quartiles");
  line.option("--episodes", &episodes, "train for so many episodes, in whole rollouts (1500 when neither this nor --steps is given)");
  line.option("--steps", &steps, "train for so many steps, in whole rollouts");
  line.option("--world", &worlds,
              "world file, or folder of them, such as policy/worlds/generate draws: every episode is in one of these, drawn when it starts "
              "(the environment itself)");
  line.option("--tables", &tables,
              "oceans that a belief thinks possible (.tables, or folders of them, of which one is of the vehicle's depth and the source's "
              "frequency); the environment's alone")
      .names("a file or a folder");
  world.add_to(line, {.source = "fixed", .start = "domain", .listening = "what RUN states, else newest"});
  line.option(
          "--state", &state,
          "what the policy sees: simple (x, y), memory (last steps and their SNR), position_memory (both) or belief (where the source may "
          "be) (simple)")
      .one_of({"simple", "memory", "position_memory", "belief"});
  line.option("--remembered-steps", &remembered_steps, "m of the memory state (2)").from(1, static_cast<int>(config::kMaxRememberedSteps));
  const program::Option one_seed = line.option("--seed", &seed, "seed of everything random (1)");
  line.option(
          "--seeds", [this](const std::string& text) { seeds = seeds_in(text); },
          "train with each of these, 1-5 or 1,2,7, on all processors: FILE.seed1.checkpoint, ...")
      .excludes(one_seed);
  line.option("--threads", &threads, "trainings at a time (all processors)").from(1, 1024);
  line.option("--environments", &environments, "episodes stepped together (1)").from(1, static_cast<int>(ppo::kMostEnvironments));
  line.flag("--force", &force, command_line::kForceHelp);
}

void check_for_resume(const program::CommandLine& line) {
  constexpr std::array<std::string_view, 9> kFree{"--resume",   "--output", "--checkpoint-every", "--curve", "--plot",
                                                  "--episodes", "--steps",  "--threads",          "--force"};
  for (const std::string& option : line.given()) {
    if (std::ranges::find(kFree, option) == kFree.end())
      throw BadInput(option + ": stays as it was in a training that --resume goes on with");
  }
}

void TrainOptions::resolve(const std::filesystem::path& directory) {
  for (auto* path : {&run_file, &world.environment}) {
    if (*path) *path = (directory / **path).string();
  }
  for (std::string& path : worlds) path = (directory / path).string();
  for (std::string& path : tables) path = (directory / path).string();
}

TrainOptions options_from(const std::vector<std::string>& arguments) {
  TrainOptions options;
  program::CommandLine line("earshot train", "");
  options.add_to(line);
  (void)line.read(arguments);
  return options;
}

ppo::TrainingRun settled(const TrainOptions& options) {
  ppo::TrainingRun run = options.run_file ? ppo::load_run(*options.run_file) : ppo::TrainingRun{};
  if (options.world.environment) run.environment = *options.world.environment;
  if (!options.worlds.empty()) run.worlds.assign(options.worlds.begin(), options.worlds.end());
  if (!options.tables.empty()) run.tables.assign(options.tables.begin(), options.tables.end());
  if (options.world.vehicle_depth_m) run.vehicle_depth = Meters{*options.world.vehicle_depth_m};
  if (options.state) run.state = description::state_named(*options.state).value();
  if (options.remembered_steps) run.remembered_steps = *options.remembered_steps;
  if (const std::size_t most = description::most_remembered(run.state); run.remembered_steps > most) {
    throw BadInput("--remembered-steps, remembered_steps: at most " + std::to_string(most) + " with the state " +
                   std::string(description::name_of(run.state)));
  }
  if (options.seed) run.seed = *options.seed;
  if (options.environments) run.hyper.environment_count = *options.environments;
  if (const ppo::Mismatch mismatch = ppo::mismatch_of(run.hyper); mismatch.key != nullptr)
    throw host::BadInput("--environments " + std::to_string(run.hyper.environment_count) + ": ppo." + mismatch.key + ": " + mismatch.what);
  if (options.episodes || options.steps) {
    run.episodes = options.episodes.value_or(0);
    run.steps = options.steps.value_or(0);
  }
  if (run.episodes == 0 && run.steps == 0) run.episodes = 1'500;
  if (run.learning_rate_schedule == ppo::LearningRateSchedule::kLinear) {
    if (run.steps == 0)
      throw BadInput(*options.run_file + ": ppo.learning_rate_schedule = \"linear\": needs steps, at which the rate is zero");
    run.hyper.decay_steps = run.steps;
  }
  return run;
}

}  // namespace earshot::training
