#include "policy/training/training.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "firmware/core/crc32.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/policy/tables_choice.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/description/trained_task.hpp"
#include "policy/ppo/checkpoint/training_state_text.hpp"
#include "policy/ppo/trainer.hpp"
#include "policy/training/curve_files.hpp"
#include "policy/training/training_worlds.hpp"
#include "sim/parallel/ordered_tasks.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/search/scenario/placement.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::training {
namespace {

using host::BadInput;

/// CRC-32 of everything that shapes a training except its length. The run file counts as a whole, because its reader may leave something
/// out of describe().
std::uint32_t settings_crc32(const TrainOptions& options, const ppo::TrainingRun& run, const ocean::Environment& environment,
                             const TrainingWorlds& drawn_from, std::uint32_t tables_crc32) {
  std::ostringstream all;
  for (const auto& [name, value] : ppo::describe(run)) {
    if (name != ppo::kDecayStepsName) all << name << " = " << value << '\n';  // how long
  }
  all << environment.file_crc32 << '\n';
  if (!drawn_from.worlds.empty()) all << drawn_from.crc32 << '\n';
  if (tables_crc32 != 0) all << tables_crc32 << '\n';
  if (options.run_file) all << host::read_text(*options.run_file, host::kTomlFile);
  return host::crc32_of(all.str());
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

}  // namespace

/// The members are made in this order: later ones refer to earlier ones.
struct Training::Parts {
  TrainingJob job;
  parallel::Ranks& ranks;
  ppo::TrainingRun run;
  search::Scenario scenario;
  search::World world;        ///< the environment's own
  TrainingWorlds drawn_from;  ///< empty: that one
  policy::ObservationModel model;
  policy::OceanTables tables;
  std::uint32_t tables_crc32 = 0;     ///< 0: the environment's ocean
  std::filesystem::path tables_file;  ///< empty: likewise
  ppo::Trainer trainer;
  LearningCurve curve;
  std::uint32_t settings_crc32;

  Parts(TrainingJob given, parallel::Ranks& r)
      : job(std::move(given)),
        ranks(r),
        run(settled(job.options)),
        scenario(command_line::scenario_at(run.environment, run.vehicle_depth)),
        world(settle_search()),
        drawn_from(run.worlds.empty() ? TrainingWorlds{} : load()),
        model(ppo::observation_of(run)),
        trainer(worlds(), model, believed_oceans(), run.hyper, run.seed, ranks),
        curve(job.resumed ? earlier_curve(job.earlier_curve, *job.resumed->continuation) : LearningCurve{}),
        settings_crc32(training::settings_crc32(job.options, run, scenario.environment, drawn_from, tables_crc32)) {}

  search::World settle_search() {
    run.search.source = scenario.environment.source.position;
    command_line::ScenarioOptions given = job.options.world;
    const bool start_is_given = given.start || given.start_margin_m;
    if (run.start == ppo::Start::kInsideBorder && !start_is_given)
      // Of whatever width the border has by now.
      given.start = search::kStartPlacements[static_cast<std::size_t>(search::StartPlacement::kInsideBorder)];
    given.apply_to(run.search);
    return search::assemble(scenario, run.search, run.vehicle_depth);
  }

  const policy::OceanTables& believed_oceans() {
    if (run.tables.empty()) {
      search::make_known_ocean(run.search, world.expected(), tables);
      return tables;
    }
    const policy::SearchedSound sound{.vehicle_depth = run.vehicle_depth,
                                      .frequency = scenario.environment.source.frequency,
                                      .furthest = range_between(run.search.domain.south_west, run.search.domain.north_east)};
    const host::TablesFile file = host::tables_for(run.tables, sound, "--tables, tables: the training");
    tables = *file.tables;
    tables_crc32 = crc32(file.bytes);
    tables_file = file.path;
    return tables;
  }

  TrainingWorlds load() const {
    program::ProgressBar bar("computing what is heard in the worlds");
    return load_worlds(run.worlds, run.search, {.vehicle_depth = run.vehicle_depth, .frequency = scenario.environment.source.frequency},
                       ranks.size() > 1 ? 1 : parallel::available_processors(), [&bar](double share) { bar.update(share); });
  }

  [[nodiscard]] std::span<const search::World> worlds() const {
    return drawn_from.worlds.empty() ? std::span(&world, 1) : std::span(drawn_from.worlds);
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
                   (drawn_from.worlds.empty() ? "" : " or one of its worlds") + (tables_crc32 == 0 ? "" : " or its ocean tables") +
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
                           {"environment_crc32", host::crc32_text(scenario.environment.file_crc32)},
                           {"steps", std::to_string(trainer.steps())}};
  if (!drawn_from.worlds.empty()) {
    checkpoint.provenance.emplace_back("worlds", std::to_string(drawn_from.worlds.size()));
    checkpoint.provenance.emplace_back("worlds_crc32", host::crc32_text(drawn_from.crc32));
  }
  if (tables_crc32 != 0) checkpoint.provenance.emplace_back("tables_crc32", host::crc32_text(tables_crc32));
  for (auto& line : description::source_place_lines(run.search)) checkpoint.provenance.push_back(std::move(line));
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
                             .curve = place_to_record(job.curve, job.output)};
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
    std::vector<std::int32_t> rank_0_ends{p.is_over() || interrupted ? 1 : 0};
    p.ranks.share(rank_0_ends);
    ends = rank_0_ends.front() != 0;
    if (ends || p.trainer.steps() - written_at >= every) {
      p.write();
      written_at = p.trainer.steps();
    }
  }
}

void Training::add_to(host::DistinctFiles& read) const {
  read.read("a file of the environment", parts_->scenario.environment.files);
  read.read("a file of a world", parts_->drawn_from.files);
  if (!parts_->tables_file.empty()) read.read("ocean tables", parts_->tables_file);
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
