#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "firmware/policy/format/policy_format.hpp"

namespace earshot::freeze {

/// Ed25519 keys. In a file each is one line of hexadecimal digits: the secret seed (64 digits), the public key (64 digits).
struct SecretKey {
  std::array<std::uint8_t, 32> seed{};
};
using PublicKey = std::array<std::uint8_t, policy::kPublicKeySize>;

/// Readies libsodium, which everything that uses it does first; again costs nothing. Throws host::BadInput when it cannot be used.
void ready_libsodium();

/// A new key from the system's random source.
[[nodiscard]] SecretKey make_key();
[[nodiscard]] PublicKey public_key_of(const SecretKey& key);

[[nodiscard]] std::string to_text(const SecretKey& key);
[[nodiscard]] std::string to_text(const PublicKey& key);
/// Throw host::BadInput, naming `file`, for anything but one line of 64 hexadecimal digits.
[[nodiscard]] SecretKey secret_key_from(std::string_view text, const std::string& file);
[[nodiscard]] PublicKey public_key_from(std::string_view text, const std::string& file);

}  // namespace earshot::freeze
