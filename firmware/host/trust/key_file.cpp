#include "firmware/host/trust/key_file.hpp"

#include <sys/stat.h>

#include <iomanip>
#include <sstream>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::host {
namespace {

constexpr mode_t kOthers = S_IRWXG | S_IRWXO;

/// Of what was opened, and not of what has its name by now.
std::string read_private(const std::filesystem::path& path, const char* kind) {
  InputFile file(path, kKeyFile);
  if (const mode_t mode = file.mode(); (mode & kOthers) != 0) {
    std::ostringstream what;
    what << path.string() << ": holds " << kind << ", and its mode " << std::setfill('0') << std::setw(4) << std::oct << (mode & 07777U)
         << " lets others read or change it: chmod 600 " << path.string() << " (make a new one if somebody else may have read it)";
    throw BadInput(what.str());
  }
  std::string text(kKeyFile.most_bytes + 1, '\0');
  text.resize(file.read({reinterpret_cast<std::uint8_t*>(text.data()), text.size()}));
  return text;
}

}  // namespace

KeyBytes read_key_file(const std::filesystem::path& path, const char* kind) {
  return key_from(read_text(path, kKeyFile), path, kind);
}

KeyBytes read_secret_key_file(const std::filesystem::path& path, const char* kind) {
  return key_from(read_private(path, kind), path, kind);
}

SecretKey read_signing_key(const std::filesystem::path& path) {
  return {.seed = read_secret_key_file(path, "a secret key")};
}

TrustedKey load_public_key(const std::filesystem::path& path) {
  return {.key = read_key_file(path, "a public key"), .file = path};
}

std::string files_of(const std::vector<TrustedKey>& keys) {
  std::string files;
  for (const TrustedKey& key : keys) files += (files.empty() ? "" : ", ") + key.file.string();
  return files;
}

}  // namespace earshot::host
