#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace earshot::host {

/// "a folder", "a pipe", "a socket", "a device" or "a regular file", by the mode that stat() gives.
[[nodiscard]] const char* type_name(mode_t mode);

/// How a name ends, from its last point on, in lower case: ".shd" of "a.b.SHD", and of ".shd" too. Oracle: FileType.*
[[nodiscard]] std::string suffix_of(const std::filesystem::path& path);

}  // namespace earshot::host
