#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/time.hpp"
#include "firmware/messages/dictionary/every_message.hpp"
#include "firmware/wire/lcm/codec.hpp"

namespace earshot::wire {

inline constexpr std::size_t kEncodedBytes = 3072;  ///< of one message; the largest, a mission's, takes 2587; full: does not compile

/// Bytes of a message. Holds them itself: nothing is allocated.
class Encoded {
 public:
  /// @param sent  of a message that does not hold its own date
  template <messages::IsDescribed Message>
  explicit Encoded(const Message& message, Time sent = {}) : size_(kLcmSize<Message>) {
    static_assert(kLcmSize<Message> <= kEncodedBytes);
    encode(message, std::span<std::uint8_t, kLcmSize<Message>>(bytes_.data(), kLcmSize<Message>), sent);
  }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }

 private:
  std::array<std::uint8_t, kEncodedBytes> bytes_;
  std::size_t size_ = 0;
};

}  // namespace earshot::wire
