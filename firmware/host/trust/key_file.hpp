#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/host/trust/keys.hpp"

namespace earshot::host {

/// A key that others may know.
/// @param kind  with its article: "a public key"
/// @throws BadInput naming the file and what it should hold
[[nodiscard]] KeyBytes read_key_file(const std::filesystem::path& path, const char* kind);

/// A key that nobody else may know. What was read on the way to it is wiped, and the process leaves no core dump (guard_memory()).
/// @throws BadInput as above, and when its mode lets others read or write it: whoever could, may sign or command already. It names the
/// chmod. Oracle: SecretKeyFile.*
[[nodiscard]] SecretKey read_secret_key_file(const std::filesystem::path& path, const char* kind);
[[nodiscard]] SecretKey read_signing_key(const std::filesystem::path& path);

/// A key that is trusted, and the file it was read from.
struct TrustedKey {
  PublicKey key{};
  std::filesystem::path file;
};
/// @throws BadInput unless the file holds 64 hexadecimal digits and nothing else.
[[nodiscard]] TrustedKey load_public_key(const std::filesystem::path& path);

/// "a.pub, b.pub"
[[nodiscard]] std::string files_of(const std::vector<TrustedKey>& keys);

}  // namespace earshot::host
