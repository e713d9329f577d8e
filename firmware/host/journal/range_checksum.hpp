#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace earshot::host {

/// Checksums of many ranges of the same bytes, however they overlap: every byte is gone through once. With c(n) the CRC-32 of the first n
/// bytes,
///
///   CRC-32 of the bytes from a to b = x^(8 (b - a)) c(a) + c(b)
///
/// as polynomials over GF(2), modulo that of CRC-32. Takes 4 bytes for each byte.
/// Oracle: RangeChecksum.*
class RangeChecksum {
 public:
  /// Other bytes from now on.
  void forget() { sums_.assign(1, 0); }

  /// CRC-32 of bytes[begin, end). @param bytes  since forget() the same, or more of them
  [[nodiscard]] std::uint32_t of(std::span<const std::uint8_t> bytes, std::size_t begin, std::size_t end);

  [[nodiscard]] std::size_t bytes_gone_through() const { return sums_.size() - 1; }  ///< since forget()

 private:
  std::vector<std::uint32_t> sums_{0};  ///< of the first n bytes
};

}  // namespace earshot::host
