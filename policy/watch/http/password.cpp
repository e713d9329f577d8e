#include "policy/watch/http/password.hpp"

#include <sodium.h>
#include <sys/stat.h>

#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/trust/keys.hpp"

namespace earshot::watch {
namespace {

constexpr host::FileKind kPasswordFile{"a password", 1024};

std::array<std::uint8_t, 32> checksum_of(std::string_view text) {
  std::array<std::uint8_t, 32> checksum{};
  crypto_generichash(checksum.data(), checksum.size(), reinterpret_cast<const unsigned char*>(text.data()), text.size(), nullptr, 0);
  return checksum;
}

}  // namespace

Password Password::of_file(const std::filesystem::path& path) {
  host::InputFile file(path, kPasswordFile);
  if ((file.mode() & (S_IRWXG | S_IRWXO)) != 0)
    throw host::BadInput(path.string() + ": holds a password, and its mode lets others read or change it: chmod 600 " + path.string());
  host::guard_memory();
  std::vector<std::uint8_t> bytes(kPasswordFile.most_bytes);
  bytes.resize(file.read(bytes));
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string_view line = all.substr(0, all.find_first_of("\r\n"));
  const bool is_long_enough = line.size() >= kLeastCharacters;
  const Password password(line);
  host::wipe(bytes);
  if (!is_long_enough)
    throw host::BadInput(path.string() + ": its first line must be a password of at least " + std::to_string(kLeastCharacters) +
                         " characters");
  return password;
}

Password::Password(std::string_view text) {
  host::ready_libsodium();
  checksum_ = checksum_of(text);
}

bool Password::is_in(std::string_view authorization) const {
  constexpr std::string_view kScheme = "Basic ";
  std::string credentials(authorization.size(), '\0');
  std::size_t size = 0;
  const bool is_basic = authorization.starts_with(kScheme);
  const std::string_view encoded = authorization.substr(is_basic ? kScheme.size() : authorization.size());
  if (sodium_base642bin(reinterpret_cast<unsigned char*>(credentials.data()), credentials.size(), encoded.data(), encoded.size(), nullptr,
                        &size, nullptr, sodium_base64_VARIANT_ORIGINAL) != 0)
    return false;
  credentials.resize(size);
  const std::size_t colon = credentials.find(':');
  if (colon == std::string::npos) return false;
  const auto given = checksum_of(std::string_view(credentials).substr(colon + 1));
  return sodium_memcmp(given.data(), checksum_.data(), checksum_.size()) == 0;
}

}  // namespace earshot::watch
