#include "policy/training/job.hpp"

#include <algorithm>
#include <utility>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/training/curve_files.hpp"

namespace earshot::training {
namespace {

using host::BadInput;

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

/// The checkpoint that is gone on from, and its curves; not where the training goes on in their place.
void add_resumed(const TrainingJob& job, host::DistinctFiles& files) {
  if (job.resumed_file.empty()) return;
  const auto read = [&files](const char* name, const std::filesystem::path& path, const std::filesystem::path& goes_on_in) {
    if (!host::are_one_file(path, goes_on_in)) files.read(name, path);
  };
  read("--resume", job.resumed_file, job.output);
  read("the learning curve of --resume", job.earlier_curve, job.curve);
  read("the losses of --resume", updates_of(job.earlier_curve), job.updates);
}

}  // namespace

host::DistinctFiles files_of(const std::vector<TrainingJob>& jobs, const TrainOptions& given) {
  const std::string checkpoint = given.output || given.resume.empty() ? "--output" : "--resume";
  const std::string curve = given.curve ? "--curve" : "the learning curve of " + checkpoint;
  host::DistinctFiles files;
  for (const TrainingJob& job : jobs) {
    files.write(checkpoint, job.output);
    files.write(curve, job.curve);
    files.write("the losses beside " + curve, job.updates);
  }
  if (given.plot) files.write("--plot", *given.plot);
  for (const TrainingJob& job : jobs) {
    if (job.options.run_file) files.read("RUN", *job.options.run_file);
    add_resumed(job, files);
  }
  return files;
}

std::vector<TrainingJob> jobs_of(const TrainOptions& options, const std::vector<std::string>& arguments) {
  if (options.resume.size() > 1 && (options.output || options.curve))
    throw BadInput("--output, --curve: for one training, not for several");
  if (!host::is_utf8(std::filesystem::current_path().string()))
    throw BadInput("the name of the current folder, which a checkpoint keeps, holds bytes that are not UTF-8");
  std::vector<TrainingJob> jobs;
  if (options.resume.empty()) jobs = new_jobs(options, arguments);
  for (const std::string& file : options.resume) jobs.push_back(job_from(file, options));
  (void)files_of(jobs, options);
  return jobs;
}

}  // namespace earshot::training
