#include "firmware/host/journal/range_checksum.hpp"

#include "firmware/core/crc32.hpp"

namespace earshot::host {
namespace {

// Polynomials as CRC-32 has them: the highest bit is the coefficient of x^0.
constexpr std::uint32_t kModulus = 0xEDB88320;
constexpr std::uint32_t kOne = std::uint32_t{1} << 31U;
constexpr std::uint32_t kXToThe8th = kOne >> 8U;

std::uint32_t product(std::uint32_t a, std::uint32_t b) {
  std::uint32_t sum = 0;
  for (std::uint32_t bit = kOne; bit != 0; bit >>= 1U) {
    if ((a & bit) != 0) sum ^= b;
    b = (b >> 1U) ^ ((b & 1U) != 0 ? kModulus : 0);
  }
  return sum;
}

/// x^(8 bytes)
std::uint32_t shift_by(std::size_t bytes) {
  std::uint32_t power = kOne;
  for (std::uint32_t square = kXToThe8th; bytes != 0; bytes >>= 1U, square = product(square, square))
    if ((bytes & 1U) != 0) power = product(power, square);
  return power;
}

}  // namespace

std::uint32_t RangeChecksum::of(std::span<const std::uint8_t> bytes, std::size_t begin, std::size_t end) {
  while (sums_.size() <= end) sums_.push_back(crc32(bytes.subspan(sums_.size() - 1, 1), sums_.back()));
  return product(shift_by(end - begin), sums_[begin]) ^ sums_[end];
}

}  // namespace earshot::host
