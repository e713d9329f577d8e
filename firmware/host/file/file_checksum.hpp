#pragma once

#include <cstdint>
#include <filesystem>

namespace earshot::host {

/// CRC-32 of a file's content, read piece by piece, going on from `previous` (0 for the first file). Throws BadInput as InputFile does.
[[nodiscard]] std::uint32_t crc32_of_file(const std::filesystem::path& path, std::uint32_t previous = 0);

}  // namespace earshot::host
