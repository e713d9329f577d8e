#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace earshot::host {

/// CRC-32 of a text's bytes. @param previous  of the bytes before them
[[nodiscard]] std::uint32_t crc32_of(std::string_view text, std::uint32_t previous = 0);

/// Eight hexadecimal digits.
[[nodiscard]] std::string crc32_text(std::uint32_t crc32);

}  // namespace earshot::host
