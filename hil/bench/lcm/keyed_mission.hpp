#pragma once

#include <filesystem>

#include "firmware/host/mission/authority/command_key.hpp"

namespace earshot::hil {

/// Of a vehicle on the bench, which anybody may know.
[[nodiscard]] host::CommandKey bench_key();

/// A copy of a mission that names bench_key(), and the key's file beside it, which its owner alone may read.
/// @param folder  is there
/// @return the copy. @throws host::BadInput, std::ios_base::failure, std::filesystem::filesystem_error
[[nodiscard]] std::filesystem::path keyed_mission(const std::filesystem::path& mission, const std::filesystem::path& folder);

}  // namespace earshot::hil
