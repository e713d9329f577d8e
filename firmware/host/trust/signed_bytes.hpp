#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/keys.hpp"

namespace earshot::host {

// Files that end in their Ed25519 signature, made over every byte before it: `.policy`, `.tables`.

/// Signs in place. @param bytes  with the signature's 64 at their end
void sign_at_end(std::span<std::uint8_t> bytes, const SecretKey& key);

/// Whether the signature at the end was made with the secret half of `key`.
[[nodiscard]] bool is_signed_at_end(std::span<const std::uint8_t> bytes, const PublicKey& key);

/// @param path  what the message calls the bytes
/// @throws BadInput unless the trusted key signed them
void require_signed_by(std::span<const std::uint8_t> bytes, const std::filesystem::path& path, const TrustedKey& trusted);

/// The same where several are trusted. @param trusted_by  what says so: "policy_keys of vehicle.toml"  @return the file of the key that
/// signed
[[nodiscard]] std::filesystem::path signer_of(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                                              const std::vector<TrustedKey>& trusted, const std::string& trusted_by);

}  // namespace earshot::host
