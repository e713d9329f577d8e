#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::support {

/// A policy that knows nothing: eight compass directions, steps of 1 km, all logits zero, actions drawn at random.
[[nodiscard]] policy::FrozenPolicy random_walk_policy();

/// The bytes of a signed `.policy` file, with what this build makes of the policy's golden trajectories.
[[nodiscard]] std::vector<std::uint8_t> signed_bytes(const policy::FrozenPolicy& policy);

/// The bytes of a signed `.tables` file, with the same key.
[[nodiscard]] std::vector<std::uint8_t> signed_bytes(const policy::OceanTables& tables);

/// Signs whatever the bytes before the signature are (a damaged policy included).
void sign(std::vector<std::uint8_t>& bytes);
/// Signs bytes that somebody changed, a CRC-32 that holds before the signature.
void mend(std::vector<std::uint8_t>& bytes);

/// The key that belongs to signed_bytes().
[[nodiscard]] std::array<std::uint8_t, policy::kPublicKeySize> public_key();

/// Writes the key that belongs to signed_bytes(), as load_policy reads it.
void write_public_key(const std::filesystem::path& path);

void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes);

}  // namespace earshot::support
