#include "policy/command_line/signing_key.hpp"

#include <filesystem>
#include <ostream>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/key_pair.hpp"

namespace earshot::command_line {
namespace {

using host::BadInput;

host::SecretKey make(const std::string& file, bool force) {
  const auto lone = force ? host::LonePublicHalf::kReplaced : host::LonePublicHalf::kStays;
  const host::SecretKey key =
      host::make_key_pair(file, lone, {.lone_public = "--force replaces it", .secret = "leave out --new-key to sign with it"});
  program::print() << file << " (secret: keep it), " << host::public_file_of(file).string() << "\n";
  return key;
}

}  // namespace

program::Option SigningKeyOptions::add_to(program::CommandLine& line) {
  const program::Option option = line.option("--key", &key, "secret key file to sign with; its public half stands beside it as .pub");
  line.flag("--new-key", &new_key,
            "make the key and its .pub first; refused when one of them exists (--force replaces a .pub without its key)");
  line.flag("--public-key", &public_key, "write the .pub of a key that has lost it");
  return option;
}

void SigningKeyOptions::add_to(host::DistinctFiles& read) const {
  read.read("--key", key);
  read.read("the public half of --key", host::public_file_of(key));
}

host::SecretKey SigningKeyOptions::read(bool force) const {
  host::require_secret_name(key);
  if (new_key) return make(key, force);
  if (!std::filesystem::exists(key)) throw BadInput(key + ": no such key; --new-key makes one");
  const host::SecretKey secret = host::read_signing_key(key);
  const std::filesystem::path public_file = host::public_file_of(key);
  if (std::filesystem::exists(public_file)) {
    host::require_public_half(secret, key);
  } else if (public_key) {
    host::write_new(public_file, host::to_text(host::public_key_of(secret)));
    program::print() << public_file.string() << "\n";
  } else {
    program::print() << public_file.string() << ": the public half, which a vehicle needs, is missing; --public-key writes it\n";
  }
  return secret;
}

}  // namespace earshot::command_line
