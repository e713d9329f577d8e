#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace earshot::journal {

/// Bytes as MCAP writes them: integers little-endian, text and maps behind their length in 32 bits.
/// Source: MCAP Format Specification, "Serialization"
class McapBytes {
 public:
  template <class Integer>
  McapBytes& number(Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
      bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8U * i) & 0xFFU));
    return *this;
  }
  McapBytes& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    return raw(text);
  }
  McapBytes& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  void clear() { bytes_.clear(); }

 private:
  std::string bytes_;
};

}  // namespace earshot::journal
