#pragma once

#include <filesystem>
#include <memory>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::evaluate {

/// Reads a `.policy` file. Throws host::BadInput, one line that names the file and the fault. The signature is not checked: a desk
/// tool may look at any policy, a vehicle may not fly it.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> load_policy(const std::filesystem::path& path);

}  // namespace earshot::evaluate
