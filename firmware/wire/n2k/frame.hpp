#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace earshot::n2k {

/// One CAN 2.0B data frame, as NMEA 2000 uses it.
struct Frame {
  std::uint32_t identifier = 0;  ///< 29 bits
  std::uint8_t size = 8;         ///< bytes of data in use, 0..8
  std::array<std::uint8_t, 8> data{};

  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {data.data(), size}; }
  friend constexpr bool operator==(const Frame&, const Frame&) = default;
};

}  // namespace earshot::n2k
