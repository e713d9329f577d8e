#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::host {

/// A policy and the bytes of its file.
struct SignedPolicy {
  std::unique_ptr<policy::FrozenPolicy> policy;
  std::vector<std::uint8_t> bytes;
};

/// Reads a `.policy` file, checks that the holder of the trusted key signed it (Ed25519), its CRC-32, its shapes and its golden pairs.
/// @param public_key  file of the trusted key: 32 bytes in hexadecimal
/// @throws host::BadInput naming the file and what is wrong with it.
[[nodiscard]] SignedPolicy load_policy(const std::filesystem::path& path, const std::filesystem::path& public_key);

/// @throws host::BadInput naming the mission's key and value, the policy and the value it was trained with, when they differ.
void check_fits(const policy::FrozenPolicy& policy, const std::filesystem::path& policy_path, const config::Mission& mission,
                const std::filesystem::path& mission_path);

}  // namespace earshot::host
