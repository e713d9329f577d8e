#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "firmware/core/status.hpp"

namespace earshot::wire {

inline constexpr std::size_t kEncodedBytes = 3072;  ///< of one message of firmware/wire/lcm; the largest, mission_t, takes 2549

/// Bytes of a message of an lcm-gen type. Holds them itself: nothing is allocated.
class Encoded {
 public:
  template <class Message>
  explicit Encoded(const Message& message) {
    const int size = message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
    size_ = size > 0 ? static_cast<std::size_t>(size) : 0;
  }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }

 private:
  std::array<std::uint8_t, kEncodedBytes> bytes_;
  std::size_t size_ = 0;
};

/// Reads an lcm-gen type. kMalformed if the fingerprint is another type's or the length does not fit; `message` is then unspecified.
/// Values are not judged here: who uses them checks that they are finite and in range.
template <class Message>
[[nodiscard]] Status decode(std::span<const std::uint8_t> bytes, Message& message) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return Status::kMalformed;
  const int size = message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return size == static_cast<int>(bytes.size()) ? Status::kOk : Status::kMalformed;
}

}  // namespace earshot::wire
