#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

namespace earshot::host {

using KeyBytes = std::array<std::uint8_t, 32>;

/// A key in a file of 64 hexadecimal digits.
/// @param kind  with its article: "a public key"
/// @throws host::BadInput naming the file and what it should hold
[[nodiscard]] KeyBytes read_key_file(const std::filesystem::path& path, const char* kind);

}  // namespace earshot::host
