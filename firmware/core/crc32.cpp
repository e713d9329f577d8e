#include "firmware/core/crc32.hpp"

#include <array>
#include <cstddef>

#include "firmware/core/wide.hpp"

namespace earshot {
namespace {

/// Bytes that are taken at once, each by a table of a kilobyte: one where there are no vectors, in a microcontroller of little flash.
constexpr std::size_t kStride = kHasVectors ? 8 : 1;
using Table = std::array<std::uint32_t, 256>;

/// The remainder of a byte that `i` others follow, for each i.
consteval std::array<Table, kStride> make_tables() {
  std::array<Table, kStride> tables{};
  for (std::uint32_t byte = 0; byte < tables[0].size(); ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0U ? 0xEDB88320U : 0U);
    tables[0][byte] = remainder;
  }
  for (std::size_t i = 1; i < kStride; ++i) {
    for (std::size_t byte = 0; byte < tables[0].size(); ++byte) {
      const std::uint32_t before = tables[i - 1][byte];
      tables[i][byte] = (before >> 8U) ^ tables[0][before & 0xFFU];
    }
  }
  return tables;
}

constexpr std::array<Table, kStride> kTables = make_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t previous) {
  std::uint32_t crc = ~previous;
  if constexpr (kStride > 1) {
    for (; bytes.size() >= kStride; bytes = bytes.subspan(kStride)) {
      std::uint32_t next = 0;
      for (std::size_t i = 0; i < kStride; ++i) {
        const std::uint32_t of_crc = i < 4 ? crc >> (8U * i) : 0U;
        next ^= kTables[kStride - 1 - i][(of_crc ^ bytes[i]) & 0xFFU];
      }
      crc = next;
    }
  }
  for (const std::uint8_t byte : bytes) crc = (crc >> 8U) ^ kTables[0][(crc ^ byte) & 0xFFU];
  return ~crc;
}

}  // namespace earshot
