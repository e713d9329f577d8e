#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/program/command_line.hpp"
#include "policy/command_line/scenario_options.hpp"
#include "policy/ppo/training_run.hpp"

namespace earshot::training {

/// The command line of `earshot train`.
struct TrainOptions {
  std::optional<std::string> run_file;
  std::vector<std::string> resume;  ///< checkpoints to go on from; none: a new training
  std::optional<std::string> output;
  std::optional<std::string> curve;
  std::optional<std::string> plot;
  std::optional<std::uint64_t> checkpoint_every;  ///< steps
  command_line::ScenarioOptions world;
  std::vector<std::string> worlds;  ///< files, and folders of them
  std::vector<std::string> tables;  ///< likewise
  std::optional<std::string> state;
  std::optional<std::size_t> remembered_steps;
  std::optional<std::uint64_t> episodes;
  std::optional<std::uint64_t> steps;
  std::optional<std::uint64_t> seed;
  std::vector<std::uint64_t> seeds;
  std::optional<std::size_t> threads;
  std::optional<std::size_t> environments;
  bool force = false;  ///< replace files that are of another kind

  void add_to(program::CommandLine& line);
  /// Makes the paths of input files absolute: those of a command that was given in `directory`.
  void resolve(const std::filesystem::path& directory);
};

/// Throws host::BadInput when `line` was given something that cannot be changed in the middle of a training.
void check_for_resume(const program::CommandLine& line);

/// The options of a command line without the program's name. Throws host::BadInput.
[[nodiscard]] TrainOptions options_from(const std::vector<std::string>& arguments);

/// The run file with the options over it. Throws host::BadInput.
[[nodiscard]] ppo::TrainingRun settled(const TrainOptions& options);

}  // namespace earshot::training
