#pragma once

#include <filesystem>
#include <vector>

namespace earshot::recording {

/// Each path as it is, and in place of a folder the recordings in it and in its folders, in the order of their paths: names that end in
/// .wav, .flac, .aif, .aiff, .caf, .w64, .rf64 or .bwf, in whatever case. What begins with a point is left out. Throws host::BadInput for a
/// folder without one. Oracle: SoundFolder.*
[[nodiscard]] std::vector<std::filesystem::path> recordings_in(const std::vector<std::filesystem::path>& paths);

}  // namespace earshot::recording
