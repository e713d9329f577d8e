#pragma once

#include <filesystem>
#include <memory>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::host {

/// Reads a `.policy` file without checking its signature: a desk tool may look at any policy, a vehicle flies only what load_policy() takes
/// (firmware/host/mission). Throws BadInput, one line that names the file and the fault.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> load_unverified_policy(const std::filesystem::path& path);

}  // namespace earshot::host
