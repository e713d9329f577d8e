#include "firmware/host/trust/key_file.hpp"

#include <sys/stat.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <sstream>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::host {
namespace {

constexpr mode_t kOthers = S_IRWXG | S_IRWXO;

/// The text of a secret, which is wiped when it goes.
struct PrivateText {
  std::array<char, kKeyFile.most_bytes + 1> bytes{};
  std::size_t size = 0;
  PrivateText() = default;
  ~PrivateText() { wipe({reinterpret_cast<std::uint8_t*>(bytes.data()), bytes.size()}); }
  PrivateText(const PrivateText&) = delete;
  PrivateText& operator=(const PrivateText&) = delete;
};

/// Of what was opened, and not of what has its name by now.
void read_private(const std::filesystem::path& path, const char* kind, PrivateText& text) {
  InputFile file(path, kKeyFile);
  if (const mode_t mode = file.mode(); (mode & kOthers) != 0) {
    std::ostringstream what;
    what << path.string() << ": holds " << kind << ", and its mode " << std::setfill('0') << std::setw(4) << std::oct << (mode & 07777U)
         << " lets others read or change it: chmod 600 " << path.string() << " (make a new one if somebody else may have read it)";
    throw BadInput(what.str());
  }
  guard_memory();
  text.size = file.read({reinterpret_cast<std::uint8_t*>(text.bytes.data()), text.bytes.size()});
}

}  // namespace

KeyBytes read_key_file(const std::filesystem::path& path, const char* kind) {
  return key_from(read_text(path, kKeyFile), path, kind);
}

SecretKey read_secret_key_file(const std::filesystem::path& path, const char* kind) {
  PrivateText text;
  read_private(path, kind, text);
  SecretKey key;
  read_key({text.bytes.data(), text.size}, path, kind, key.seed);
  return key;
}

SecretKey read_signing_key(const std::filesystem::path& path) {
  return read_secret_key_file(path, "a secret key");
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
