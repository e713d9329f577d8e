#include "policy/freeze/freeze.hpp"

#include <iostream>
#include <optional>

#include "firmware/config_file/table_reader.hpp"
#include "policy/apps/program.hpp"
#include "policy/freeze/keys.hpp"

namespace {

using namespace earshot;
using config_file::BadInput;

struct Options {
  std::optional<std::string> checkpoint;
  std::optional<std::string> output;
  std::string draw = "sampled";
  std::string key;
  bool new_key = false;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("CHECKPOINT", options.checkpoint, "checkpoint of earshot train");
  app.add_option("-o,--output", options.output, "policy to write (.policy)");
  app.add_option("--draw", options.draw, "how the vehicle draws its actions: sampled from the softmax, or argmax")
      ->check(CLI::IsMember({"argmax", "sampled"}))
      ->capture_default_str();
  app.add_option("--key", options.key, "secret key file to sign with; its public half stands beside it as .pub")->required();
  app.add_flag("--new-key", options.new_key, "make the key and its .pub first; refused when the key exists");
}

freeze::SecretKey new_key(const std::filesystem::path& file) {
  if (file.extension() == ".pub") throw BadInput(file.string() + ": a secret key must not end in .pub, the public key's name");
  if (std::filesystem::exists(file)) throw BadInput(file.string() + ": exists already; --new-key does not replace keys");
  const freeze::SecretKey key = freeze::make_key();
  apps::write_whole(file, to_text(key), apps::Access::kOwnerOnly);
  const std::filesystem::path public_file = std::filesystem::path(file).replace_extension(".pub");
  apps::write_whole(public_file, freeze::to_text(freeze::public_key_of(key)));
  std::cout << file.string() << " (secret: keep it), " << public_file.string() << "\n";
  return key;
}

freeze::SecretKey key_of(const Options& options) {
  if (options.new_key) return new_key(options.key);
  if (!std::filesystem::exists(options.key)) throw BadInput(options.key + ": no such key; --new-key makes one");
  return freeze::secret_key_from(apps::read_whole(options.key), options.key);
}

void freeze_checkpoint(const Options& options) {
  if (options.checkpoint.has_value() != options.output.has_value()) throw BadInput("earshot freeze: CHECKPOINT and --output go together");
  if (!options.checkpoint && !options.new_key) throw BadInput("earshot freeze: nothing to do: no CHECKPOINT and no --new-key");
  std::unique_ptr<policy::FrozenPolicy> policy;
  if (options.checkpoint) {
    const ppo::Checkpoint checkpoint = ppo::from_text(apps::read_whole(*options.checkpoint), *options.checkpoint);
    policy = freeze::freeze(checkpoint, options.draw == "argmax" ? policy::ActionDraw::kArgmax : policy::ActionDraw::kSampled);
    apps::check_writable(*options.output);
  }
  const freeze::SecretKey key = key_of(options);
  if (!options.checkpoint) return;
  const std::vector<std::uint8_t> bytes = freeze::sign(*policy, key);
  apps::write_whole(*options.output, std::string(bytes.begin(), bytes.end()));
  std::cout << *options.output << ": " << bytes.size() << " bytes, " << policy->observation.spec.size() << " observations, "
            << policy->actions.size() << " actions, " << options.draw << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Freezes a trained policy into the signed file that a vehicle flies.", "earshot freeze");
  app.footer("Example: earshot freeze fixed.checkpoint -o fixed.policy --key earshot.key --new-key");
  Options options;
  add_options(app, options);
  return apps::run_program(app, argc, argv, [&] { freeze_checkpoint(options); });
}
