#include "firmware/wire/serial/cobs.hpp"

#include <cassert>

namespace earshot::wire {
namespace {

/// Of a run of 254 bytes without a zero, behind which none is meant.
constexpr std::uint8_t kLongest = 0xFF;

}  // namespace

std::size_t stuff(std::span<const std::uint8_t> from, std::span<std::uint8_t> to) {
  assert(to.size() >= cobs_room(from.size()));
  std::size_t code_at = 0;
  std::size_t size = 1;
  std::uint8_t code = 1;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] != 0) {
      to[size++] = from[i];
      ++code;
    }
    const bool is_full = code == kLongest;
    if (from[i] != 0 && !(is_full && i + 1 < from.size())) continue;
    to[code_at] = code;
    code_at = size++;
    code = 1;
  }
  to[code_at] = code;
  to[size++] = 0;
  return size;
}

CobsReader::Outcome CobsReader::take(std::uint8_t byte) {
  if (byte == 0) {
    const bool is_whole = left_ == 0 && !is_too_long_;
    whole_ = is_whole ? size_ : 0;
    const bool is_empty = size_ == 0 && !is_zero_due_ && !is_too_long_ && left_ == 0;
    size_ = 0;
    left_ = 0;
    is_zero_due_ = is_too_long_ = false;
    if (is_empty) return Outcome::kNothing;  // a line may be woken with zeros
    return is_whole ? Outcome::kFrame : Outcome::kBroken;
  }
  if (left_ > 0) {
    put(byte);
    --left_;
    return Outcome::kNothing;
  }
  if (is_zero_due_) put(0);
  left_ = static_cast<std::uint8_t>(byte - 1);
  is_zero_due_ = byte != kLongest;
  return Outcome::kNothing;
}

void CobsReader::put(std::uint8_t byte) {
  is_too_long_ = is_too_long_ || size_ == room_.size();
  if (!is_too_long_) room_[size_++] = byte;
}

}  // namespace earshot::wire
