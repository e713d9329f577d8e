#include "policy/freeze/freeze.hpp"

#include <optional>
#include <ostream>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/file_checksum.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/key_pair.hpp"
#include "policy/command_line/listening_options.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/policy_details.hpp"
#include "policy/command_line/run.hpp"
#include "policy/command_line/signing_key.hpp"
#include "policy/description/draw.hpp"
#include "policy/description/state.hpp"
#include "policy/description/trained_task.hpp"
#include "policy/freeze/model_file.hpp"
#include "policy/freeze/thaw.hpp"
#include "policy/ppo/training_run.hpp"

namespace {

using namespace earshot;
using host::BadInput;

struct Options {
  std::optional<std::string> model;
  std::optional<std::string> output;
  std::optional<std::string> search;
  std::optional<std::string> draw;
  command_line::ListeningOptions listening;
  command_line::SigningKeyOptions key;
  bool force = false;
};

void add_options(program::CommandLine& line, Options& options) {
  line.option(
      "MODEL", &options.model,
      "checkpoint of earshot train, model.zip of Stable-Baselines3 (PPO or A2C, MlpPolicy), an ONNX export, a .policy to freeze again, or "
      "a run file of earshot train (TOML, its state \"belief\"): that makes a policy without a network, which goes by the belief's own "
      "advice");
  line.option("-o,--output", &options.output, "policy to write (.policy)");
  line.option(
      "--search", &options.search,
      "what a .zip or .onnx was trained to search, when it does not carry that along (JSON: earshot.gym.sb3.describe() in policy/python)");
  line.option(
          "--draw", &options.draw,
          "how the vehicle draws its actions: sampled from the softmax, or argmax; without it sampled, of a .policy as it does, without a "
          "network argmax")
      .one_of({description::kDraws.begin(), description::kDraws.end()});
  options.listening.add_to(line, "what MODEL has: what it was trained with, of a .policy what it was last frozen with");
  options.key.add_to(line).required();
  line.flag("--force", &options.force, command_line::kForceHelp);
}

std::string search_of(const freeze::TrainedActor& actor, const Options& options) {
  if (actor.search && options.search) throw BadInput("carries its own search description; --search is for models that carry none");
  if (actor.search) return *actor.search;
  if (options.search) return host::read_text(*options.search, host::kJsonFile);
  throw BadInput("does not state what it was trained to search: save it with earshot.gym.sb3.save or export_onnx, or give --search");
}

policy::ActionDraw draw_of(const Options& options) {
  return description::draw_named(options.draw.value_or("sampled")).value();
}

/// What is wrong is wrong with the model.
template <class Work>
auto naming(const std::filesystem::path& file, Work work) {
  try {
    return work();
  } catch (const BadInput& e) {
    throw BadInput(file.string() + ": " + freeze::printable(e.what()));
  }
}

/// Of the model and, one after another, of the files that hold its weights.
std::uint32_t crc32_of(const std::string& bytes, const freeze::TrainedActor& actor) {
  std::uint32_t crc32 = host::crc32_of(bytes);
  for (const std::filesystem::path& file : actor.data_files) crc32 = host::crc32_of_file(file, crc32);
  return crc32;
}

/// What is read, and what is written, which is none of it, unless it is a policy whose owner says so: one of an older format is made anew
/// in its place.
host::DistinctFiles files_of(const Options& options, bool is_policy) {
  host::DistinctFiles files;
  if (!is_policy || !options.force) files.read("MODEL", *options.model);
  if (options.search) files.read("--search", *options.search);
  options.key.add_to(files);
  files.write("--output", *options.output);
  return files;
}

std::unique_ptr<policy::FrozenPolicy> freeze_foreign(const std::string& bytes, const std::filesystem::path& file, const Options& options,
                                                     host::DistinctFiles files) {
  const freeze::TrainedActor actor = freeze::read_model(bytes, file.string());
  files.read("weights of MODEL", actor.data_files);
  return naming(file, [&] {
    description::SearchDescription search = description::from_text(search_of(actor, options));
    search.provenance.emplace_back("model", file.filename().string());
    search.provenance.emplace_back("model_crc32", host::crc32_text(crc32_of(bytes, actor)));
    return freeze::freeze(actor, search, draw_of(options));
  });
}

std::unique_ptr<policy::FrozenPolicy> freeze_again(const std::string& text, const std::filesystem::path& file, const Options& options) {
  if (options.search) throw BadInput("--search: a policy states itself what it was trained to search");
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  std::unique_ptr<policy::FrozenPolicy> policy = freeze::thaw(bytes, file.string());
  const std::string key = host::to_text(freeze::signer_of(bytes));
  program::detail() << file.string() << ": was signed with the secret half of " << key;
  if (options.draw) policy->draw = description::draw_named(*options.draw).value();
  return policy;
}

/// A policy for the search of a run file, which nothing is trained for.
std::unique_ptr<policy::FrozenPolicy> freeze_untrained(const std::filesystem::path& file, const Options& options) {
  if (options.search) throw BadInput("--search: a run file states itself what is searched");
  const ppo::TrainingRun run = ppo::load_run(file);
  if (run.state != description::State::kBelief)
    throw BadInput(file.string() + ": state = \"" + std::string(description::name_of(run.state)) +
                   "\": a run that is not trained must have \"belief\", whose advice is flown");
  description::SearchDescription search = description::describe(run.search, ppo::observation_of(run));
  search.provenance = {
      {"run", file.filename().string()}, {"commit", program::build_commit()}, {"network", "none: the belief's own advice"}};
  for (auto& line : description::task_lines(run.search, run.vehicle_depth)) search.provenance.push_back(std::move(line));
  return freeze::freeze_advice(search, description::draw_named(options.draw.value_or("argmax")).value());
}

std::unique_ptr<policy::FrozenPolicy> freeze_model(const std::filesystem::path& file, const Options& options) {
  const std::string bytes = host::read_text(file, host::kModelFile);
  const host::DistinctFiles files = files_of(options, freeze::is_policy(bytes));
  if (file.extension() == ".toml") return freeze_untrained(file, options);
  if (freeze::is_policy(bytes)) return freeze_again(bytes, file, options);
  if (freeze::is_foreign_model(bytes, file.string())) return freeze_foreign(bytes, file, options, files);
  if (options.search) throw BadInput("--search: a checkpoint states itself what it was trained to search");
  const ppo::Checkpoint checkpoint = ppo::from_text(bytes, file.string());
  return naming(file, [&] { return freeze::freeze(checkpoint, draw_of(options)); });
}

std::unique_ptr<policy::FrozenPolicy> policy_of(const Options& options) {
  std::unique_ptr<policy::FrozenPolicy> policy = freeze_model(*options.model, options);
  if (!options.listening.is_given()) return policy;
  const config::ListeningWindow window = options.listening.applied_to(policy->observation.listening);
  naming(*options.model, [&] { freeze::listen_over(*policy, window); });
  return policy;
}

void run(const Options& options) {
  if (options.model.has_value() != options.output.has_value()) throw BadInput("earshot freeze: MODEL and --output go together");
  if (!options.model && !options.key.only_makes_keys())
    throw BadInput("earshot freeze: nothing to do: no MODEL, no --new-key and no --public-key");
  std::unique_ptr<policy::FrozenPolicy> policy;
  if (options.model) {
    policy = policy_of(options);
    host::require_writable(*options.output, command_line::kPolicyOutput, host::replaced_by(options.force));
  }
  const host::SecretKey key = options.key.read(options.force);
  if (!options.model) return;
  const std::vector<std::uint8_t> bytes = freeze::sign(*policy, key);
  host::write_whole(*options.output, std::string(bytes.begin(), bytes.end()));
  command_line::print_policy_details(*options.model, *policy);
  program::detail() << options.key.key << ": signed with it; a vehicle trusts " << host::public_file_of(options.key.key).string() << "\n";
  program::print() << *options.output << ": " << bytes.size() << " bytes, " << policy->observation.spec.size()
                   << " elements of observation, " << policy->actions.size() << " actions, " << command_line::network_text(policy->network)
                   << ", " << description::name_of(policy->draw) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot freeze", "Freezes a trained policy into the signed file that a vehicle flies.");
  line.footer("Example: earshot freeze fixed.checkpoint -o fixed.policy --key earshot.key --new-key");
  Options options;
  add_options(line, options);
  return command_line::run(line, argc, argv, [&] { run(options); });
}
