#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace earshot {

/// Writes a number's last bytes, the most significant first. @param bytes  as many as it shall take, at most 8
/// Oracle: BigEndian.*
inline void store_big_endian(std::span<std::uint8_t> bytes, std::uint64_t value) {
  for (std::size_t i = bytes.size(); i-- > 0; value >>= 8U) bytes[i] = static_cast<std::uint8_t>(value);
}

/// @param bytes  of a number, the most significant first, at most 8
/// Oracle: BigEndian.*
[[nodiscard]] inline std::uint64_t load_big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = (value << 8U) | byte;
  return value;
}

}  // namespace earshot
