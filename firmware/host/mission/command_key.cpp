#include "firmware/host/mission/command_key.hpp"

#include <sodium.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace earshot::host {
namespace {

constexpr std::uint64_t kNotSaid = 0x7ff8'0000'0000'0000U;

/// What is marked, byte by byte.
class MarkedBytes {
 public:
  explicit MarkedBytes(const messages::OperatorCommand& command) {
    append(static_cast<std::uint64_t>(command.time.us), 8);
    append(static_cast<std::uint64_t>(command.expiry.us), 8);
    append(command.issuer, 4);
    append(command.number, 4);
    append(static_cast<std::uint64_t>(command.order), 1);
    const messages::OperatorLimits& limits = command.limits;
    append(limits.max_depth ? std::bit_cast<std::uint64_t>(limits.max_depth->value) : kNotSaid, 8);
    append(limits.max_speed ? std::bit_cast<std::uint64_t>(limits.max_speed->value) : kNotSaid, 8);
    append(limits.max_time_s ? std::bit_cast<std::uint64_t>(*limits.max_time_s) : kNotSaid, 8);
  }
  static constexpr std::size_t kSize = 49;
  [[nodiscard]] const std::uint8_t* data() const { return bytes_.data(); }

 private:
  void append(std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) bytes_[size_++] = static_cast<std::uint8_t>(value >> (8U * i));
  }

  std::array<std::uint8_t, kSize> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace

messages::CommandMark CommandKey::mark_of(const messages::OperatorCommand& command) const {
  static_assert(sizeof(messages::CommandMark) == crypto_generichash_BYTES_MIN);
  static_assert(sizeof(KeyBytes) == crypto_generichash_KEYBYTES);
  const MarkedBytes bytes(command);
  messages::CommandMark mark{};
  (void)crypto_generichash(mark.data(), mark.size(), bytes.data(), MarkedBytes::kSize, key_.data(), key_.size());  // fails for sizes only
  return mark;
}

bool CommandKey::verifies(const messages::OperatorCommand& command) const {
  const messages::CommandMark mark = mark_of(command);
  return sodium_memcmp(mark.data(), command.mark.data(), mark.size()) == 0;
}

}  // namespace earshot::host
