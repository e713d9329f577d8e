#include "firmware/host/trust/key_pair.hpp"

#include <system_error>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/trust/key_file.hpp"

namespace earshot::host {
namespace {

/// The secret half goes again when the public one cannot have its name.
void write_pair(const std::filesystem::path& secret_file, const SecretKey& key, bool replaces) {
  const std::filesystem::path public_file = public_file_of(secret_file);
  OutputFile secret_half(secret_file, Access::kOwnerOnly);
  OutputFile public_half(public_file, Access::kOwnerWrites);
  std::string secret = to_text(key);
  secret_half.write(secret);
  wipe({reinterpret_cast<std::uint8_t*>(secret.data()), secret.size()});
  public_half.write(to_text(public_key_of(key)));
  secret_half.commit_as_new();
  try {
    replaces ? public_half.commit() : public_half.commit_as_new();
  } catch (const BadInput&) {
    std::error_code gone_already;
    std::filesystem::remove(followed(secret_file), gone_already);
    throw;
  }
}

}  // namespace

std::filesystem::path public_file_of(std::filesystem::path secret_file) {
  return secret_file.replace_extension(".pub");
}

void require_secret_name(const std::filesystem::path& secret_file) {
  if (public_file_of(secret_file) == secret_file)
    throw BadInput(secret_file.string() + ": a secret key must not end in .pub, the public key's name");
}

SecretKey make_key_pair(const std::filesystem::path& secret_file, LonePublicHalf lone, const WaysOut& ways_out) {
  require_secret_name(secret_file);
  if (std::filesystem::exists(secret_file))
    throw BadInput(secret_file.string() + ": exists already; a key is never replaced: " + ways_out.secret);
  const std::filesystem::path public_file = public_file_of(secret_file);
  const bool replaces = std::filesystem::exists(public_file);
  if (replaces) (void)load_public_key(public_file);
  if (replaces && lone == LonePublicHalf::kStays)
    throw BadInput(public_file.string() + ": is the public half of a key that is not here, which a vehicle may trust; " +
                   ways_out.lone_public);
  const SecretKey key = make_key();
  write_pair(secret_file, key, replaces);
  return key;
}

void require_public_half(const SecretKey& key, const std::filesystem::path& secret_file) {
  const std::filesystem::path public_file = public_file_of(secret_file);
  if (load_public_key(public_file).key != public_key_of(key))
    throw BadInput(public_file.string() + ": is not the public half of " + secret_file.string());
}

}  // namespace earshot::host
