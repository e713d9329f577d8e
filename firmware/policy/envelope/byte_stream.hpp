#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace earshot::policy {

/// Writes little-endian values one after the other; once the bytes are full it writes no more and says so.
class ByteWriter {
 public:
  explicit ByteWriter(std::span<std::uint8_t> bytes) : bytes_(bytes) {}

  void u8(std::uint8_t value) {
    if (position_ < bytes_.size()) {
      bytes_[position_++] = value;
    } else {
      full_ = true;
    }
  }
  void u16(std::uint16_t value) { little_endian(value, 2); }
  void u32(std::uint32_t value) { little_endian(value, 4); }
  void f32(float value) { little_endian(std::bit_cast<std::uint32_t>(value), 4); }
  void f64(double value) { little_endian(std::bit_cast<std::uint64_t>(value), 8); }

  /// Writes over four bytes that have been written.
  void u32_at(std::size_t position, std::uint32_t value) {
    ByteWriter there(bytes_.first(position_).subspan(position));
    there.u32(value);
  }

  [[nodiscard]] bool full() const { return full_; }
  [[nodiscard]] std::size_t position() const { return position_; }

 private:
  void little_endian(std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) u8(static_cast<std::uint8_t>(value >> (8U * i)));
  }

  std::span<std::uint8_t> bytes_;
  std::size_t position_ = 0;
  bool full_ = false;
};

/// Reads little-endian values one after the other; past the end it reads zeros and says so.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t u8() {
    if (position_ < bytes_.size()) return bytes_[position_++];
    past_end_ = true;
    return 0;
  }
  std::uint16_t u16() { return static_cast<std::uint16_t>(little_endian(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(little_endian(4)); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(little_endian(8)); }

  /// The bytes that come next, as a reader of their own; fewer where there are not so many.
  ByteReader take(std::size_t count) {
    const std::size_t there = count < remaining() ? count : remaining();
    past_end_ = past_end_ || there < count;
    position_ += there;
    return ByteReader(bytes_.subspan(position_ - there, there));
  }

  [[nodiscard]] bool past_end() const { return past_end_; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - position_; }

 private:
  std::uint64_t little_endian(unsigned bytes) {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < bytes; ++i) value |= std::uint64_t{u8()} << (8U * i);
    return value;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
  bool past_end_ = false;
};

}  // namespace earshot::policy
