// earshot sign: who signs a mission vouches for its bytes and for those of its policy and its ocean tables.

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <string>
#include <system_error>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/key_pair.hpp"
#include "firmware/host/trust/signature_file.hpp"

namespace {

using namespace earshot;

struct Options {
  std::filesystem::path key;
  std::filesystem::path mission;
  std::uint64_t counter = 0;
};

/// A mission that could not be flown is not signed.
authority::MissionManifest manifest_of(const Options& o) {
  const std::string text = host::read_text(o.mission, host::kTomlFile);
  if (text.starts_with("EARSHOTP") || text.starts_with("EARSHOTT"))
    throw host::BadInput(o.mission.string() +
                         ": policies and ocean tables carry their signature within them; earshot freeze and earshot tables make that");
  // As any vehicle reads it that asks for a signature; which commands it obeys is that vehicle's to say.
  const host::MissionFile file = host::load_mission(
      o.mission, text, {.stated_in = {}, .command_key = host::CommandKey(host::KeyBytes{}), .reads_own_command_key = false});
  host::require_named_files(file);
  const std::vector<std::uint8_t> policy = host::read_policy_bytes(file.policy);
  const std::unique_ptr<policy::FrozenPolicy> parsed = host::policy_from(policy, file.policy);
  host::check_fits(*parsed, file.policy, file.mission, o.mission);
  const host::TablesFile tables = host::tables_of(file.tables, *parsed, file.mission, o.mission);
  return {.counter = o.counter, .mission = host::sha256_of(std::string_view(text)), .policy = host::digest_of(policy, tables.bytes)};
}

/// A vehicle that has flown the later mission refuses the earlier one: who signs it by mistake hears of it at his desk.
void warn_of_rollback(const std::filesystem::path& signature, std::uint64_t counter) {
  std::error_code error;
  if (!std::filesystem::exists(signature, error)) return;
  std::uint64_t before = 0;
  try {
    before = host::read_signature(signature).manifest.counter;
  } catch (const host::BadInput&) {
    return;  // one of ours that was damaged may go without a word
  }
  if (before > counter)
    std::cerr << "earshot sign: warning: " << host::printable(signature.string()) << " bore counter " << before
              << ": a vehicle that has flown that refuses " << counter << "\n";
}

int run(const Options& o) {
  host::require_secret_name(o.key);
  const host::SecretKey key = host::read_signing_key(o.key);
  host::require_public_half(key, o.key);
  const authority::MissionManifest manifest = manifest_of(o);
  const std::filesystem::path output = host::signature_file_of(o.mission);
  host::require_writable(output, host::kSignatureOutput, host::Replace::kOwnKind, "move it away");
  warn_of_rollback(output, manifest.counter);
  host::write_whole(output, host::to_text(host::sign(manifest, key)));
  program::print() << output.string() << ": " << o.mission.string() << " and its policy, with its ocean tables, counter "
                   << manifest.counter << ", by the holder of " << host::public_file_of(o.key).string() << "\n";
  return program::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot sign", "Signs a mission, the policy that it names and its ocean tables: MISSION.sig, beside it.");
  line.footer("Example: earshot sign --key ops.key --counter 7 search.toml");
  Options options;
  line.option("MISSION", &options.mission, "mission file (TOML); it stays as it is").required();
  line.option("--key", &options.key, "secret key to sign with (earshot key)").required();
  line.option("--counter", &options.counter,
              "greater than that of every mission that was signed for the vehicle before; one that has flown a mission refuses all with a "
              "lower counter")
      .required()
      .from(1, std::numeric_limits<std::int64_t>::max());
  return program::run(line, argc, argv, [&] { return run(options); });
}
