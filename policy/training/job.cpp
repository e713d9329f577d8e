#include "policy/training/job.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/ppo/trainer.hpp"
#include "policy/ppo/training_state_text.hpp"

namespace earshot::training {
namespace {

using host::BadInput;

/// Some ten million episodes.
constexpr host::FileKind kLearningCurve{"a learning curve", std::uint64_t{1} << 30U};

ppo::Continuation::Written written(const std::string& text) {
  return {text.size(), host::crc32_of(text)};
}

/// CRC-32 of everything that shapes a training except its length. The run file counts as a whole, because its reader may leave something
/// out of describe().
std::uint32_t settings_crc32(const TrainOptions& options, const ppo::TrainingRun& run, const ocean::Environment& environment) {
  std::ostringstream all;
  for (const auto& [name, value] : ppo::describe(run)) {
    if (name != ppo::kDecayStepsName) all << name << " = " << value << '\n';  // how long
  }
  all << environment.file_crc32 << '\n';
  if (options.run_file) all << host::read_text(*options.run_file, host::kTomlFile);
  return host::crc32_of(all.str());
}

/// "a.csv" -> "a.updates.csv"
std::filesystem::path updates_of(std::filesystem::path curve) {
  return curve.replace_extension(".updates.csv");
}

/// The curve of a checkpoint for which none is named: "a.checkpoint" -> "a.csv"
std::filesystem::path curve_beside(std::filesystem::path checkpoint) {
  return checkpoint.replace_extension(".csv");
}

/// A curve's file as it was when the checkpoint was written.
std::string earlier_part(const std::filesystem::path& path, const ppo::Continuation::Written& part) {
  host::InputFile file(path, kLearningCurve);
  std::string text(std::min<std::uint64_t>(part.bytes, file.size()), '\0');
  text.resize(file.read({reinterpret_cast<std::uint8_t*>(text.data()), text.size()}));
  if (text.size() < part.bytes) throw BadInput(path.string() + ": shorter than when the checkpoint was written");
  if (host::crc32_of(text) != part.crc32) throw BadInput(path.string() + ": not the learning curve of the checkpoint");
  return text;
}

LearningCurve earlier_curve(const TrainingJob& job) {
  if (!job.resumed) return {};
  try {
    return {earlier_part(job.earlier_curve, job.resumed->continuation->episodes),
            earlier_part(updates_of(job.earlier_curve), job.resumed->continuation->updates)};
  } catch (const std::invalid_argument& e) {
    throw BadInput(job.earlier_curve.string() + ": " + e.what());
  }
}

/// An episode and the steps that all ranks had taken by its end.
struct EpisodeAtStep {
  std::uint64_t steps;
  search::EpisodeRecord episode;
};

/// Gathers, on rank 0, the episodes of all ranks in the order of their steps, those of one step in the order of ranks.
std::vector<EpisodeAtStep> gather_episodes(parallel::Ranks& ranks, const std::vector<EpisodeAtStep>& mine) {
  if (ranks.size() == 1) return mine;
  std::vector<EpisodeAtStep> all;
  for (const std::vector<EpisodeAtStep>& theirs : parallel::gather_values(ranks, std::span(mine)))
    all.insert(all.end(), theirs.begin(), theirs.end());
  std::ranges::stable_sort(all, {}, &EpisodeAtStep::steps);
  return all;
}

/// "a.checkpoint" -> "a.seed3.checkpoint"
std::filesystem::path with_seed(const std::filesystem::path& path, std::uint64_t seed) {
  std::filesystem::path result = path;
  return result.replace_extension(".seed" + std::to_string(seed) + path.extension().string());
}

/// The curve that the command line names, before a seed is put into the name.
std::filesystem::path curve_of(const TrainOptions& options) {
  return options.curve ? std::filesystem::path(*options.curve) : curve_beside(*options.output);
}

std::vector<TrainingJob> new_jobs(const TrainOptions& options, const std::vector<std::string>& arguments) {
  if (!options.output) throw BadInput("--output: no checkpoint to write given");
  std::vector<TrainingJob> jobs;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, options.seeds.size()); ++i) {
    TrainingJob job{.options = options,
                    .output = *options.output,
                    .curve = curve_of(options),
                    .updates = {},
                    .arguments = arguments,
                    .directory = std::filesystem::current_path()};
    if (!options.seeds.empty()) {
      job.options.seed = options.seeds[i];
      job.output = with_seed(job.output, options.seeds[i]);
      job.curve = with_seed(job.curve, options.seeds[i]);
    }
    job.updates = updates_of(job.curve);
    jobs.push_back(std::move(job));
  }
  return jobs;
}

/// The place of the curve that a checkpoint records; where it records none, the place that its command line named.
std::filesystem::path recorded_curve(const std::filesystem::path& checkpoint, const TrainingJob& job) {
  const ppo::Continuation& continuation = *job.resumed->continuation;
  if (continuation.curve && !continuation.curve->empty()) return checkpoint.parent_path() / *continuation.curve;
  if (continuation.curve || !job.options.curve) return curve_beside(checkpoint);
  const std::filesystem::path curve = job.directory / *job.options.curve;
  return job.options.seeds.empty() ? curve : with_seed(curve, continuation.state.seed);
}

/// The curve's place as its checkpoint keeps it: so that both can be moved together, and copied under another name where one is the
/// other's.
std::string curve_to_record(const TrainingJob& job) {
  if (job.curve == curve_beside(job.output)) return {};
  const std::filesystem::path curve = std::filesystem::absolute(job.curve).lexically_normal();
  const std::filesystem::path below = curve.lexically_relative(std::filesystem::absolute(job.output).lexically_normal().parent_path());
  return below.empty() || *below.begin() == ".." ? curve.string() : below.string();
}

TrainingJob job_from(const std::string& file, const TrainOptions& given) {
  TrainingJob job;
  job.resumed_file = file;
  job.resumed = ppo::from_text(host::read_text(file, host::kModelFile), file);
  if (!job.resumed->continuation) throw BadInput(file + ": holds networks alone, from elsewhere: nothing to go on with");
  const ppo::Continuation& continuation = *job.resumed->continuation;
  job.arguments = continuation.arguments;
  job.directory = continuation.directory;
  try {
    job.options = options_from(job.arguments);
  } catch (const BadInput& e) {
    throw BadInput(file + ": its command line is not this program's: " + e.what());
  }
  job.options.resolve(job.directory);
  job.options.seed = continuation.state.seed;
  if (given.episodes || given.steps) {
    job.options.episodes = given.episodes;
    job.options.steps = given.steps;
  }
  job.options.force = given.force;
  if (given.checkpoint_every) job.options.checkpoint_every = given.checkpoint_every;
  job.output = given.output.value_or(file);
  job.earlier_curve = recorded_curve(file, job);
  std::error_code error;
  const bool was_moved = given.curve && !std::filesystem::exists(job.earlier_curve, error);
  if (was_moved) job.earlier_curve = *given.curve;
  job.curve = given.curve ? std::filesystem::path(*given.curve) : given.output ? curve_beside(job.output) : job.earlier_curve;
  job.updates = updates_of(job.curve);
  return job;
}

constexpr host::OutputKind kCheckpointOutput{"a checkpoint of earshot train", {R"({"format":"earshot checkpoint)", {}}};
constexpr host::OutputKind kCurveOutput{"a learning curve (CSV)", {"episode,", {}}};
constexpr host::OutputKind kLossesOutput{"the losses of a training (CSV)", {"steps,episodes,", {}}};

void check_files(const std::vector<TrainingJob>& jobs, const TrainOptions& given) {
  const std::string checkpoint = given.output || given.resume.empty() ? "--output" : "--resume";
  const std::string curve = given.curve ? "--curve" : "the learning curve of " + checkpoint;
  std::vector<command_line::Output> files;
  for (const TrainingJob& job : jobs) {
    files.push_back({checkpoint, job.output, kCheckpointOutput});
    files.push_back({curve, job.curve, kCurveOutput});
    files.push_back({"the losses beside " + curve, job.updates, kLossesOutput});
  }
  if (given.plot) files.push_back({"--plot", *given.plot, host::picture_kind(*given.plot)});
  command_line::check_distinct(files);
}

}  // namespace

std::vector<TrainingJob> jobs_of(const TrainOptions& options, const std::vector<std::string>& arguments) {
  if (options.resume.size() > 1 && (options.output || options.curve))
    throw BadInput("--output, --curve: for one training, not for several");
  if (!host::is_utf8(std::filesystem::current_path().string()))
    throw BadInput("the name of the current folder, which a checkpoint keeps, holds bytes that are not UTF-8");
  std::vector<TrainingJob> jobs;
  if (options.resume.empty()) jobs = new_jobs(options, arguments);
  for (const std::string& file : options.resume) jobs.push_back(job_from(file, options));
  check_files(jobs, options);
  return jobs;
}

/// The members are made in this order: later ones refer to earlier ones.
struct Training::Parts {
  TrainingJob job;
  parallel::Ranks& ranks;
  ppo::TrainingRun run;
  ocean::Environment environment;
  search::Soundscape soundscape;
  search::SearchWorld world;
  policy::ObservationModel model;
  ppo::Trainer trainer;
  LearningCurve curve;
  std::uint32_t settings_crc32;

  Parts(TrainingJob given, parallel::Ranks& r)
      : job(std::move(given)),
        ranks(r),
        run(settled(job.options)),
        environment(apps::environment_at(run.environment, run.vehicle_depth)),
        soundscape(settle_search()),
        world(run.search, soundscape, environment.conditions),
        model(ppo::observation_of(run, soundscape.expected())),
        trainer(world, model, run.hyper, run.seed, ranks),
        curve(earlier_curve(job)),
        settings_crc32(training::settings_crc32(job.options, run, environment)) {}

  search::Soundscape settle_search() {
    run.search.source = environment.source.position;
    apps::WorldOptions world_options = job.options.world;
    const bool start_is_given = world_options.start || world_options.start_margin_m;
    if (run.start == ppo::Start::kInsideBorder && !start_is_given)
      world_options.start = "inside_border";  // of whatever width it has by now
    world_options.apply_to(run.search);
    return apps::soundscape_for(environment, run.vehicle_depth, run.search);
  }

  void resume();
  void refuse_divergence() const;
  void write();
  void record(const std::vector<EpisodeAtStep>& episodes, const ppo::UpdateReport& update);
  [[nodiscard]] ppo::Checkpoint checkpoint(ppo::TrainingState state) const;
  [[nodiscard]] bool is_over() const {
    return (run.steps > 0 && trainer.steps() >= run.steps) || (run.episodes > 0 && curve.episodes() >= run.episodes);
  }
  [[nodiscard]] TrainingProgress::At progress() const;
};

void Training::Parts::resume() {
  const ppo::Continuation& continuation = *job.resumed->continuation;
  if (continuation.settings_crc32 != settings_crc32) {
    throw BadInput(job.resumed_file.string() + ": cannot go on: its environment" + (job.options.run_file ? " or run file" : "") +
                   " is not what it was, or the program's defaults are not");
  }
  if (continuation.state.workers.size() != ranks.size()) {
    throw BadInput(job.resumed_file.string() + ": was trained by " + std::to_string(continuation.state.workers.size()) +
                   " ranks, goes on with as many");
  }
  if (!trainer.resume(job.resumed->parameters, continuation.state))
    throw BadInput(job.resumed_file.string() + ": its state does not fit its settings");
}

/// All ranks have the same parameters and moments, and so come to the same verdict.
void Training::Parts::refuse_divergence() const {
  const ppo::Adam::State& optimiser = trainer.optimiser();
  const auto are_finite = [](std::span<const float> values) {
    return std::ranges::all_of(values, [](float x) { return std::isfinite(x); });
  };
  if (are_finite(trainer.networks().parameters()) && are_finite(optimiser.first_moment) && are_finite(optimiser.second_moment)) return;
  throw BadInput(job.output.string() + ": diverged at step " + std::to_string(trainer.steps()) +
                 ": a weight or its moment is no finite number; nothing written, lower learning_rate");
}

ppo::Checkpoint Training::Parts::checkpoint(ppo::TrainingState state) const {
  ppo::Checkpoint checkpoint{description::describe(run.search, model), {}};
  std::string command = "earshot-train";
  for (const std::string& word : job.arguments) command += " " + word;
  checkpoint.provenance = {{"command", command},
                           {"commit", program::build_commit()},
                           {"environment", run.environment.filename().string()},
                           {"environment_crc32", host::crc32_text(environment.file_crc32)},
                           {"steps", std::to_string(trainer.steps())}};
  if (ranks.size() > 1) checkpoint.provenance.emplace_back("ranks", std::to_string(ranks.size()));
  const auto settings = ppo::describe(run);
  checkpoint.provenance.insert(checkpoint.provenance.end(), settings.begin(), settings.end());
  const std::span<const float> parameters = trainer.networks().parameters();
  checkpoint.parameters.assign(parameters.begin(), parameters.end());
  checkpoint.continuation = {.state = std::move(state),
                             .arguments = job.arguments,
                             .directory = job.directory.string(),
                             .settings_crc32 = settings_crc32,
                             .episodes = written(curve.episodes_csv()),
                             .updates = written(curve.updates_csv()),
                             .curve = curve_to_record(job)};
  return checkpoint;
}

/// Writes the curves first: a checkpoint never counts more episodes than they hold.
void Training::Parts::write() {
  ppo::TrainingState state = trainer.state();
  if (ranks.size() > 1) {
    const std::vector<std::string> all = ranks.gather(to_text(state.workers.front()));
    state.workers.clear();
    for (const std::string& worker : all) state.workers.push_back(ppo::worker_from_text(worker));
  }
  if (ranks.rank() > 0) return;
  host::write_whole(job.curve, curve.episodes_csv());
  host::write_whole(job.updates, curve.updates_csv());
  host::write_whole(job.output, to_text(checkpoint(std::move(state))));
}

void Training::Parts::record(const std::vector<EpisodeAtStep>& episodes, const ppo::UpdateReport& update) {
  for (const EpisodeAtStep& each : episodes) curve.add(each.episode, each.steps);
  curve.add(update, trainer.steps());
}

TrainingProgress::At Training::Parts::progress() const {
  const double by_episodes = run.episodes > 0 ? static_cast<double>(curve.episodes()) / static_cast<double>(run.episodes) : 0.0;
  const double by_steps = run.steps > 0 ? static_cast<double>(trainer.steps()) / static_cast<double>(run.steps) : 0.0;
  return {.fraction = std::min(1.0, std::max(by_episodes, by_steps)),
          .steps = trainer.steps(),
          .episodes = curve.episodes(),
          .recent = curve.recent()};
}

Training::Training(TrainingJob job, parallel::Ranks& ranks) : parts_(std::make_unique<Parts>(std::move(job), ranks)) {
  if (parts_->job.resumed) parts_->resume();
  if (ranks.rank() > 0) return;
  const TrainingJob& outputs = parts_->job;
  const host::Replace replace = host::replaced_by(outputs.options.force);
  host::require_writable(outputs.output, kCheckpointOutput, replace);
  host::require_writable(outputs.curve, kCurveOutput, replace);
  host::require_writable(outputs.updates, kLossesOutput, replace);
}

Training::~Training() = default;

void Training::run(TrainingProgress& progress, std::size_t number, const std::atomic<bool>& interrupted) {
  Parts& p = *parts_;
  const std::uint64_t every = p.job.options.checkpoint_every.value_or(std::numeric_limits<std::uint64_t>::max());
  std::uint64_t written_at = p.trainer.steps();
  progress.begin(number, p.progress());
  bool ends = p.is_over();
  while (!ends) {
    std::vector<EpisodeAtStep> episodes;
    const ppo::UpdateReport update = p.trainer.advance([&episodes](const search::EpisodeRecord& episode, std::uint64_t steps) {
      episodes.push_back({steps, episode});
      return true;
    });
    p.refuse_divergence();
    p.record(gather_episodes(p.ranks, episodes), update);
    progress.update(number, p.progress());
    std::vector<std::int32_t> rank_0_says{p.is_over() || interrupted ? 1 : 0};
    p.ranks.share(rank_0_says);
    ends = rank_0_says.front() != 0;
    if (ends || p.trainer.steps() - written_at >= every) {
      p.write();
      written_at = p.trainer.steps();
    }
  }
}

const TrainingJob& Training::job() const {
  return parts_->job;
}
const ppo::TrainingRun& Training::run_settings() const {
  return parts_->run;
}

const LearningCurve& Training::curve() const {
  return parts_->curve;
}
std::uint64_t Training::steps() const {
  return parts_->trainer.steps();
}

}  // namespace earshot::training
