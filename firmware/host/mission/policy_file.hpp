#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/policy/format/policy_format.hpp"

namespace earshot::host {

/// A policy, the bytes of its file, and who signed it.
struct SignedPolicy {
  std::unique_ptr<policy::FrozenPolicy> policy;
  std::vector<std::uint8_t> bytes;
  std::filesystem::path signer;  ///< file of the trusted key
};

[[nodiscard]] std::vector<std::uint8_t> read_policy_bytes(const std::filesystem::path& path);

/// Reads a `.policy` file, checks that the holder of the trusted key signed it (Ed25519), its CRC-32, its sizes and numbers. That this
/// machine repeats its golden trajectories is for the Runtime to find that is armed with it, or for require_repeats_golden.
/// @param public_key  file of the trusted key: 32 bytes in hexadecimal
/// @throws host::BadInput naming the file and what is wrong with it.
[[nodiscard]] SignedPolicy load_policy(const std::filesystem::path& path, const std::filesystem::path& public_key);

/// load_policy() of bytes that have been read from `path`.
[[nodiscard]] SignedPolicy signed_policy_from(std::vector<std::uint8_t> bytes, const std::filesystem::path& path,
                                              const TrustedKey& trusted);
/// The same where several are trusted. @param trusted_by  what says so: "policy_keys of vehicle.toml"
[[nodiscard]] SignedPolicy signed_policy_from(std::vector<std::uint8_t> bytes, const std::filesystem::path& path,
                                              const std::vector<TrustedKey>& trusted, const std::string& trusted_by);

/// @throws host::BadInput naming the mission's key and value, the policy and the value it was trained with, when they differ.
void check_fits(const policy::FrozenPolicy& policy, const std::filesystem::path& policy_path, const config::Mission& mission,
                const std::filesystem::path& mission_path);

}  // namespace earshot::host
