#include <algorithm>
#include <memory>
#include <ostream>
#include <sstream>

#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/run.hpp"
#include "policy/description/state.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/training/curve_plot.hpp"
#include "policy/training/job.hpp"
#include "policy/training/training.hpp"
#include "sim/parallel/ordered_tasks.hpp"
#include "sim/parallel/rank_session.hpp"
#include "sim/search/scenario/placement.hpp"

namespace {

using namespace earshot;
using host::BadInput;
using Trainings = std::vector<std::unique_ptr<training::Training>>;

Trainings prepare(const training::TrainOptions& options, const std::vector<std::string>& arguments, parallel::Ranks& ranks) {
  if (options.plot) {
    command_line::check_picture_name("--plot", *options.plot);
    if (ranks.rank() == 0) host::require_writable(*options.plot, host::picture_kind(*options.plot), host::replaced_by(options.force));
  }
  std::vector<training::TrainingJob> jobs = training::jobs_of(options, arguments);
  if (jobs.size() > 1 && ranks.size() > 1) throw BadInput("several trainings at once share no MPI ranks: start mpirun for each");
  host::DistinctFiles files = training::files_of(jobs, options);
  Trainings trainings;
  for (training::TrainingJob& job : jobs) trainings.push_back(std::make_unique<training::Training>(std::move(job), ranks));
  for (const auto& each : trainings) each->add_to(files);
  return trainings;
}

void run_all(const Trainings& trainings, std::size_t threads, training::TrainingProgress& progress) {
  program::stop_on_signals(program::SecondSignal::kEndsAtOnce);
  auto run = [&](std::size_t i) { trainings[i]->run(progress, i, program::stop_requested); };
  if (trainings.size() == 1) return run(0);  // MPI wants the main thread
  parallel::run_in_order({.groups = trainings.size(), .tasks_per_group = 1, .threads = threads, .window = trainings.size()}, run,
                         [](std::size_t) {});
}

/// Prints the settings of every training, with --verbose.
void print_settings(const Trainings& trainings, std::size_t threads, std::size_t ranks) {
  program::detail() << host::counted(trainings.size(), "training") << ", " << std::min(threads, trainings.size()) << " at a time, "
                    << host::counted(ranks, "process", "processes") << "\n";
  for (const auto& training : trainings) {
    const training::TrainingJob& job = training->job();
    program::detail() << job.output.string() << ", " << job.curve.string() << ", " << job.updates.string()
                      << ":\n  environment = " << training->run_settings().environment.string() << "\n";
    for (const auto& [name, value] : ppo::describe(training->run_settings())) program::detail() << "  " << name << " = " << value << "\n";
  }
}

void print_summary(const Trainings& trainings, double seconds) {
  std::vector<double> medians;
  std::vector<double> found;
  for (const auto& training : trainings) {
    const training::LearningCurve::Recent last = training->curve().recent();
    if (last.episodes > 0) {
      medians.push_back(last.median_reward);
      found.push_back(last.found_fraction);
    }
    program::print() << training->job().output.string() << ": " << training->curve().episodes() << " episodes, " << training->steps()
                     << " steps; ";
    if (last.episodes > 0) {
      program::print() << "last " << last.episodes << " episodes: median reward " << last.median_reward << ", found "
                       << 100.0 * last.found_fraction << " %\n";
    } else {
      program::print() << "no episode has ended\n";
    }
  }
  if (trainings.size() > 1 && !medians.empty()) {
    auto of_seeds = [](const std::vector<double>& x, double scale) {
      std::ostringstream text;
      text << scale * evaluate::quantile(x, 0.5) << " (quartiles " << scale * evaluate::quantile(x, 0.25) << " and "
           << scale * evaluate::quantile(x, 0.75) << ")";
      return text.str();
    };
    program::print() << "median of " << medians.size() << " trainings: median reward " << of_seeds(medians, 1.0) << ", found "
                     << of_seeds(found, 100.0) << " %\n";
  }
  if (program::stop_requested) program::print() << "interrupted; go on with earshot train --resume\n";
  program::print() << "trained for " << host::decimals(seconds, 1) << " s\n";
}

/// "Reward in training: changing source; the policy observes its belief about the source; seed 1"
std::string title_of(const Trainings& trainings) {
  const ppo::TrainingRun& run = trainings.front()->run_settings();
  return "Reward in training: " + std::string(search::name_of(run.search.placement)) + " source; the policy observes " +
         std::string(description::what_is_observed(run.state)) + "; " +
         (trainings.size() == 1 ? "seed " + std::to_string(run.seed) : std::to_string(trainings.size()) + " seeds");
}

void train(const training::TrainOptions& options, const std::vector<std::string>& arguments, parallel::RankSession& session) {
  const bool speaks = session.ranks().rank() == 0;
  Trainings trainings;
  session.all_or_none<BadInput>([&] { trainings = prepare(options, arguments, session.ranks()); });

  const std::size_t threads = options.threads.value_or(parallel::available_processors());
  if (speaks) print_settings(trainings, threads, session.ranks().size());
  training::TrainingProgress progress(trainings.size(), speaks && program::talk() != program::Talk::kQuiet
                                                            ? training::TrainingProgress::Voice::kSpeaks
                                                            : training::TrainingProgress::Voice::kSilent);
  run_all(trainings, threads, progress);
  if (!speaks) return;
  progress.finish();
  if (options.plot) {
    std::vector<std::string> curves;
    for (const auto& each : trainings) curves.push_back(each->curve().episodes_csv());
    training::draw_curves(*options.plot, title_of(trainings), curves);
  }
  print_summary(trainings, progress.seconds());
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot train", "Trains a search policy by PPO in the simulated ocean.");
  line.footer(
      "Example: earshot train --environment sim/ocean/environments/munk_flat.toml --state simple --source fixed --episodes 1500 -o "
      "fixed.checkpoint\n"
      "Ctrl-C writes the checkpoint; earshot train --resume fixed.checkpoint goes on.\n"
      "mpirun -n N earshot-train ... trains one policy with N times the environments and the batch.");
  training::TrainOptions options;
  options.add_to(line);
  return command_line::run_ranked(line, argc, argv, [&](parallel::RankSession& session) {
    if (!options.resume.empty()) training::check_for_resume(line);
    train(options, std::vector<std::string>(argv + 1, argv + argc), session);
  });
}
