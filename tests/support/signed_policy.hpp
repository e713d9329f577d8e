#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::support {

/// A policy that knows nothing: eight compass directions, steps of 1 km, all logits zero, actions drawn at random.
[[nodiscard]] policy::FrozenPolicy random_walk_policy();

/// The bytes of a signed `.policy` file.
[[nodiscard]] std::vector<std::uint8_t> signed_bytes(const policy::FrozenPolicy& policy);

/// Signs whatever the bytes before the signature are (a damaged policy included).
void sign(std::vector<std::uint8_t>& bytes);

/// Writes the key that belongs to signed_bytes(), as load_policy reads it.
void write_public_key(const std::filesystem::path& path);

void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes);

}  // namespace earshot::support
