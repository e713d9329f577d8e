#pragma once

#include <cstdint>
#include <span>

namespace earshot {

/// CRC-32 of IEEE 802.3 (reflected polynomial 0xEDB88320), as zlib, PNG and Ethernet use it.
/// @param previous  CRC of the bytes before these, to go on from; 0 at the beginning
/// Oracle: Crc32.GivesThePublishedCheckValue
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t previous = 0);

}  // namespace earshot
