#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "firmware/host/trust/keys.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::freeze {

/// Whether the bytes of a file are a `.policy`, of whatever version.
[[nodiscard]] bool is_policy(std::string_view bytes);

/// The policy in a `.policy` file of this version of the format, everything bit for bit but its golden trajectories, which are flown again:
/// what another build's arithmetic made of them is no reason to refuse it here.
/// Throws host::BadInput, one line that begins with `file`, for anything else, damage, and a signature that is not that of the key in it.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> thaw(std::span<const std::uint8_t> bytes, const std::string& file);

/// Who signed the bytes of a `.policy` that thaw() takes.
[[nodiscard]] host::PublicKey signer_of(std::span<const std::uint8_t> bytes);

}  // namespace earshot::freeze
