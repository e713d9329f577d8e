#pragma once

#include <filesystem>

namespace earshot::host {

/// A file or folder that ships with the running program: of the tree that it was built in (it stands in build/PRESET/bin), or of its
/// installation (in bin, beside share/earshot).
/// @param relative  as in the source tree: "sim/ocean/environments/munk_flat.toml"
/// @throws BadInput when it is in neither.
[[nodiscard]] std::filesystem::path shipped(const std::filesystem::path& relative);

}  // namespace earshot::host
