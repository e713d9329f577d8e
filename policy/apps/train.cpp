#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <deque>
#include <iostream>
#include <limits>
#include <sstream>

#include "firmware/config_file/table_reader.hpp"
#include "policy/apps/program.hpp"
#include "policy/apps/world_options.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/ppo/checkpoint.hpp"
#include "policy/ppo/trainer.hpp"
#include "policy/ppo/training_run.hpp"

namespace {

using namespace earshot;

struct Options {
  std::optional<std::string> run_file;
  std::string output;
  std::optional<std::string> curve;
  apps::WorldOptions world;
  std::optional<std::string> state;
  std::optional<std::size_t> remembered_steps;
  std::optional<std::uint64_t> episodes;
  std::optional<std::uint64_t> steps;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> environments;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("RUN", options.run_file,
                 "run file (TOML) with every setting, such as policy/ppo/runs/fixed_source.toml; options override it");
  app.add_option("-o,--output", options.output, "checkpoint to write")->required();
  app.add_option("--curve", options.curve, "learning curve to write, CSV (the checkpoint's name with .csv)");
  options.world.add_to(app);
  app.add_option("--state", options.state,
                 "what the policy sees: simple (x, y), memory (last steps and their SNR) or belief (where the source may be) (simple)")
      ->check(CLI::IsMember({"simple", "memory", "belief"}));
  app.add_option("--remembered-steps", options.remembered_steps, "m of the memory state (2)")
      ->check(CLI::Range(1, static_cast<int>(config::kMaxRememberedSteps)));
  app.add_option("--episodes", options.episodes, "train for so many episodes (1500 when neither this nor --steps is given)");
  app.add_option("--steps", options.steps, "train for so many steps, rounded up to whole rollouts");
  app.add_option("--seed", options.seed, "seed of everything random (1)");
  app.add_option("--environments", options.environments, "episodes stepped together (1)")->check(CLI::Range(1, 65'536));
}

ppo::TrainingRun settled(const Options& options) {
  ppo::TrainingRun run = options.run_file ? ppo::load_run(*options.run_file) : ppo::TrainingRun{};
  if (options.world.environment) run.environment = *options.world.environment;
  if (options.world.vehicle_depth_m) run.vehicle_depth = Meters{*options.world.vehicle_depth_m};
  if (options.state) run.state = ppo::state_named(*options.state);
  if (options.remembered_steps) run.remembered_steps = *options.remembered_steps;
  if (options.seed) run.seed = *options.seed;
  if (options.environments) run.hyper.environment_count = *options.environments;
  if (options.episodes || options.steps) {
    run.episodes = options.episodes.value_or(0);
    run.steps = options.steps.value_or(0);
  }
  if (run.episodes == 0 && run.steps == 0) run.episodes = 1'500;
  return run;
}

/// Learning curve and progress, fed one episode at a time.
class Log {
 public:
  explicit Log(const ppo::TrainingRun& run) : run_(run), terminal_(isatty(STDERR_FILENO) != 0) { curve_ << "episode,steps,reward,found\n"; }

  /// False when the run's episodes are used up.
  bool add(const search::EpisodeRecord& episode, std::uint64_t steps) {
    ++episodes_;
    steps_ = steps;
    const bool found = episode.end == search::EpisodeEnd::kFound;
    curve_ << episodes_ << ',' << steps << ',' << episode.reward << ',' << (found ? 1 : 0) << '\n';
    recent_.push_back(episode);
    if (recent_.size() > 50) recent_.pop_front();
    if (Clock::now() - shown_ > (terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(5'000))) show();
    return run_.episodes == 0 || episodes_ < run_.episodes;
  }

  void finish() {
    show();
    if (terminal_) std::cerr << '\n';
  }

  [[nodiscard]] std::string curve() const { return curve_.str(); }
  [[nodiscard]] std::uint64_t episodes() const { return episodes_; }
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  [[nodiscard]] evaluate::Summary recent() const {
    const std::vector<search::EpisodeRecord> records(recent_.begin(), recent_.end());
    return records.empty() ? evaluate::Summary{} : evaluate::summarise(records);
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double fraction_done() const {
    const double by_episodes = run_.episodes > 0 ? static_cast<double>(episodes_) / static_cast<double>(run_.episodes) : 0.0;
    const double by_steps = run_.steps > 0 ? static_cast<double>(steps_) / static_cast<double>(run_.steps) : 0.0;
    return std::min(1.0, std::max(by_episodes, by_steps));
  }

  void show() {
    shown_ = Clock::now();
    const double elapsed = seconds();
    const double left = fraction_done() > 0.0 ? elapsed * (1.0 / fraction_done() - 1.0) : 0.0;
    const evaluate::Summary last = recent();
    std::fprintf(
        stderr, "%s%3.0f %%  %llu episodes  %llu steps  %.0f steps/s  last 50: median reward %.1f, found %.0f %%  %.0f s left   %s",
        terminal_ ? "\r" : "", 100.0 * fraction_done(), static_cast<unsigned long long>(episodes_), static_cast<unsigned long long>(steps_),
        static_cast<double>(steps_) / elapsed, last.median_reward, 100.0 * last.found_fraction, left, terminal_ ? "" : "\n");
  }

  const ppo::TrainingRun& run_;
  bool terminal_;
  std::ostringstream curve_;
  std::deque<search::EpisodeRecord> recent_;
  std::uint64_t episodes_ = 0;
  std::uint64_t steps_ = 0;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_ = begin_;
};

ppo::Checkpoint checkpoint_of(const ppo::Trainer& trainer, const policy::ObservationModel& model, const ppo::TrainingRun& run,
                              const ocean::Environment& environment, const std::string& command) {
  ppo::Checkpoint checkpoint;
  checkpoint.observation = model;
  checkpoint.direction_count = run.search.direction_count;
  checkpoint.step_length = run.search.step_length;
  checkpoint.area_size = run.search.domain.north_east - run.search.domain.south_west;
  checkpoint.detection_threshold = run.search.detection_threshold;
  std::ostringstream crc;
  crc << std::hex << std::setw(8) << std::setfill('0') << environment.file_crc32;
  checkpoint.provenance = {{"command", command},
                           {"commit", apps::build_commit()},
                           {"environment", run.environment.filename().string()},
                           {"environment_crc32", crc.str()},
                           {"steps", std::to_string(trainer.steps())}};
  const auto settings = ppo::describe(run);
  checkpoint.provenance.insert(checkpoint.provenance.end(), settings.begin(), settings.end());
  const std::span<const float> parameters = trainer.networks().parameters();
  checkpoint.parameters.assign(parameters.begin(), parameters.end());
  return checkpoint;
}

void train(const Options& options, const std::string& command) {
  ppo::TrainingRun run = settled(options);
  const ocean::Environment environment = apps::environment_at(run.environment, run.vehicle_depth);
  run.search.source = environment.source.position;
  options.world.apply_to(run.search);
  const std::filesystem::path output = options.output;
  const std::filesystem::path curve_file =
      options.curve ? std::filesystem::path(*options.curve) : std::filesystem::path(output).replace_extension(".csv");
  if (curve_file == output) throw config_file::BadInput("--curve: must not be the checkpoint itself");
  apps::check_writable(output);
  apps::check_writable(curve_file);

  const sonar::SnrCurve curve = apps::curve_for(environment, run.vehicle_depth, run.search);
  const search::SearchWorld world(run.search, curve);
  const policy::ObservationModel model = ppo::observation_of(run, curve);
  ppo::Trainer trainer(world, model, run.hyper, run.seed);
  Log log(run);
  trainer.train(run.steps > 0 ? run.steps : std::numeric_limits<std::uint64_t>::max(),
                [&log](const search::EpisodeRecord& episode, std::uint64_t steps) { return log.add(episode, steps); });
  log.finish();

  apps::write_whole(curve_file, log.curve());
  apps::write_whole(output, to_text(checkpoint_of(trainer, model, run, environment, command)));
  const evaluate::Summary last = log.recent();
  std::cout << log.episodes() << " episodes, " << trainer.steps() << " steps in " << log.seconds() << " s; last " << last.episodes
            << " episodes: median reward " << last.median_reward << ", found " << 100.0 * last.found_fraction << " %\n"
            << output.string() << "\n"
            << curve_file.string() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Trains a search policy by PPO in the simulated ocean.", "earshot train");
  app.footer(
      "Example: earshot train --environment sim/ocean/environments/munk_flat.toml --state simple --source fixed --episodes 1500 -o "
      "fixed.checkpoint");
  Options options;
  add_options(app, options);
  return apps::run_program(app, argc, argv, [&] { train(options, apps::command_line(argc, argv)); });
}
