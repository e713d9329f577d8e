#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/policy/envelope/envelope.hpp"
#include "firmware/policy/envelope/policy_fault.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::policy {

inline constexpr std::uint32_t kFormatVersion = 4;

/// Size of the largest serialised policy, bytes.
[[nodiscard]] std::size_t max_serialised_size();

/// Reads the bytes of a `.policy` file into `policy` and judges it with check(). Whether this build repeats its golden trajectories is
/// left to who has the memory for it (repeats_golden). On failure `policy` is unspecified.
/// Layout (little-endian): see README.md of this folder. The bytes end with public key, CRC-32, signature.
[[nodiscard, gnu::cold]] Status parse(std::span<const std::uint8_t> bytes, FrozenPolicy& policy, PolicyComplaint& complaint);

/// Writes `policy` as the bytes of a `.policy` file, its golden trajectories as they are, CRC-32 in place, signature bytes zero
/// (policy/freeze signs).
/// @return number of bytes written; kFull if `bytes` is too small; kOutOfRange for a policy that parse() would refuse.
[[nodiscard]] Result<std::size_t> serialise(const FrozenPolicy& policy, std::span<const std::uint8_t, kPublicKeySize> public_key,
                                            std::span<std::uint8_t> bytes);

}  // namespace earshot::policy
