#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/authority/mission_manifest.hpp"

namespace earshot::host {

/// In a file each key is one line of 64 hexadecimal digits.
using KeyBytes = std::array<std::uint8_t, 32>;
using PublicKey = authority::Ed25519Key;
using Signature = authority::Ed25519Signature;

/// Fills it with zeros, which no optimiser leaves out.
void wipe(std::span<std::uint8_t> bytes);

/// A key that nobody else may know, such as the half of an Ed25519 pair that signs: the seed that the rest follows from. Wiped when it
/// goes.
struct SecretKey {
  KeyBytes seed{};
  ~SecretKey() { wipe(seed); }
};

/// From now on this process leaves no core dump, and nobody but root reads its memory: it holds a secret.
void guard_memory();

/// Readies libsodium, which everything that uses it does first; again costs nothing. Throws BadInput when it cannot be used.
void ready_libsodium();

/// A new key from the system's random source.
[[nodiscard]] SecretKey make_key();
/// Oracle: Keys.FollowTheFirstTestVectorOfRfc8032
[[nodiscard]] PublicKey public_key_of(const SecretKey& key);

/// Ed25519. Source: RFC 8032. Oracle: Keys.SignAsRfc8032Prints
[[nodiscard]] Signature sign(std::span<const std::uint8_t> message, const SecretKey& key);
[[nodiscard]] bool is_signed(std::span<const std::uint8_t> message, std::span<const std::uint8_t, 64> signature, const PublicKey& key);

/// Oracle: Sha256Of.IsWhatFips180Prints
[[nodiscard]] authority::Sha256 sha256_of(std::span<const std::uint8_t> bytes);
[[nodiscard]] authority::Sha256 sha256_of(std::string_view text);

/// Two digits a byte, lower case.
[[nodiscard]] std::string to_hex(std::span<const std::uint8_t> bytes);
/// Fills `bytes` with as many as `text` has digits for. @return whether it had exactly so many, and nothing else
[[nodiscard]] bool from_hex(std::string_view text, std::span<std::uint8_t> bytes);

/// The line of a key's file.
[[nodiscard]] std::string to_text(const SecretKey& key);
[[nodiscard]] std::string to_text(const PublicKey& key);
/// @param kind  with its article: "a public key"
/// @throws BadInput, naming `file`, for anything but 64 hexadecimal digits and the end of the line
void read_key(std::string_view text, const std::filesystem::path& file, const char* kind, KeyBytes& key);
[[nodiscard]] KeyBytes key_from(std::string_view text, const std::filesystem::path& file, const char* kind);

}  // namespace earshot::host
