#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <system_error>

namespace earshot::host {

/// Whether a byte of UTF-8 goes on with a character that began before it.
[[nodiscard]] constexpr bool goes_on(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

/// "1 step", "12 steps"
struct Counted {
  std::uint64_t count = 0;
  std::string_view what;
};

/// Text in the making, in memory of somebody else's; what does not fit is left out, whole characters only. Allocates nothing.
class TextInto {
 public:
  explicit TextInto(std::span<char> memory) : memory_(memory) {}

  TextInto& operator<<(std::string_view text) {
    std::size_t count = std::min(text.size(), left());
    while (count > 0 && count < text.size() && goes_on(text[count])) --count;
    std::copy_n(text.begin(), count, memory_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
    return *this;
  }
  TextInto& operator<<(std::integral auto number) {
    std::array<char, 24> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
  }
  TextInto& operator<<(Counted things) { return *this << things.count << " " << things.what << (things.count == 1 ? "" : "s"); }
  /// A number too long for its field stands as "?".
  TextInto& decimal(double number, int places) {
    std::array<char, 32> digits{};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, places);
    return *this << (error == std::errc{} ? std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())) : "?");
  }
  TextInto& two_digits(unsigned number) { return *this << (number < 10 ? "0" : "") << number; }

  [[nodiscard]] std::size_t left() const { return memory_.size() - size_; }  ///< bytes
  [[nodiscard]] std::string_view text() const { return {memory_.data(), size_}; }

 private:
  std::span<char> memory_;
  std::size_t size_ = 0;
};

struct TextMemory {
  std::array<char, 256> bytes{};
};

/// Text in the making, in memory of its own.
class TextLine : private TextMemory, public TextInto {
 public:
  TextLine() : TextInto(bytes) {}
  ~TextLine() = default;
  TextLine(const TextLine&) = delete;
  TextLine& operator=(const TextLine&) = delete;
};

}  // namespace earshot::host
