#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "firmware/core/time.hpp"

namespace earshot::fuzz {

/// What a target is: tries one input. Throws std::logic_error when something came of it that must not.
void judge(std::span<const std::uint8_t> bytes);

/// As long as one lives, nothing may be taken from the heap: the program ends when something was. Where a sanitizer brings a heap of its
/// own nothing is counted.
class WithoutHeap {
 public:
  WithoutHeap();
  ~WithoutHeap();
  WithoutHeap(const WithoutHeap&) = delete;
  WithoutHeap& operator=(const WithoutHeap&) = delete;
};

inline void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// A refusal names its file first and tells what is wrong with it, in each of its lines.
inline void require_names_file(const std::string& refusal, const std::string& file) {
  for (std::size_t begin = 0; begin <= refusal.size();) {
    const std::size_t end = std::min(refusal.find('\n', begin), refusal.size());
    if (!refusal.substr(begin, end - begin).starts_with(file)) throw std::logic_error("a refusal does not begin with its file: " + refusal);
    begin = end + 1;
  }
}

/// A message of nothing but its date.
template <class Message>
Message dated(Time time) {
  Message message;
  message.time = time;
  return message;
}

/// The bytes of an input, one after the other; behind its end there are zeros.
class Input {
 public:
  explicit Input(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] bool is_used_up() const { return rest_.empty(); }
  [[nodiscard]] std::uint8_t byte() {
    const std::span<const std::uint8_t> one = bytes(1);
    return one.empty() ? std::uint8_t{0} : one.front();
  }
  [[nodiscard]] std::uint16_t word() {
    const unsigned low = byte();
    return static_cast<std::uint16_t>(low | (static_cast<unsigned>(byte()) << 8U));
  }
  /// So many, or all that are left.
  [[nodiscard]] std::span<const std::uint8_t> bytes(std::size_t count) {
    const std::span<const std::uint8_t> first = rest_.first(std::min(count, rest_.size()));
    rest_ = rest_.subspan(first.size());
    return first;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Spoils good bytes as the input says: where (2 bytes), how many (1), then these, laid over by exclusive or.
inline void spoil(std::span<std::uint8_t> good, Input& input) {
  const std::size_t at = input.word();
  const std::span<const std::uint8_t> over = input.bytes(input.byte());
  for (std::size_t i = 0; i < over.size() && at + i < good.size(); ++i) good[at + i] ^= over[i];
}

}  // namespace earshot::fuzz
