#include "hil/bus/decode/text.hpp"

#include <algorithm>

namespace earshot::hil {

namespace {

constexpr std::size_t kHeaderBytes = 2;
constexpr std::uint8_t kUtf16 = 0;
constexpr std::uint8_t kSingleByteCharacters = 1;
constexpr std::uint32_t kByteOrderMark = 0xFEFF;
constexpr std::uint32_t kReplacement = 0xFFFD;  ///< of half a character

void append_utf8(std::string& text, std::uint32_t code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
    return;
  }
  const unsigned more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  const std::uint32_t lead = (0xFF00U >> (more + 1)) & 0xFFU;
  text += static_cast<char>(lead | code >> (6 * more));
  for (unsigned i = more; i > 0; --i) text += static_cast<char>(0x80U | (code >> (6 * (i - 1)) & 0x3FU));
}

std::string from_utf16(std::span<const std::uint8_t> bytes) {
  const auto unit = [&](std::size_t i) { return i + 1 < bytes.size() ? bytes[i] | std::uint32_t{bytes[i + 1]} << 8U : 0; };
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code == 0 || code == 0xFFFF) break;
    if (code == kByteOrderMark) continue;
    const std::uint32_t next = unit(i + 2);
    if (code >= 0xD800 && code < 0xDC00 && next >= 0xDC00 && next < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10U) + (next - 0xDC00);
      i += 2;
    } else if (code >= 0xD800 && code < 0xE000) {
      code = kReplacement;
    }
    append_utf8(text, code);
  }
  return text;
}

std::string from_bytes(std::span<const std::uint8_t> bytes) {
  const auto is_end = [](std::uint8_t byte) { return byte == 0 || byte == 0xFF; };
  return {bytes.begin(), std::ranges::find_if(bytes, is_end)};
}

}  // namespace

std::optional<std::string> take_text(std::span<const std::uint8_t>& bytes) {
  if (bytes[0] < kHeaderBytes || bytes[0] > bytes.size()) {
    bytes = {};
    return std::nullopt;
  }
  const std::uint8_t encoding = bytes[1];
  const auto characters = bytes.subspan(kHeaderBytes, bytes[0] - kHeaderBytes);
  bytes = bytes.subspan(bytes[0]);
  if (characters.empty()) return "";
  if (encoding == kUtf16) return from_utf16(characters);
  return encoding == kSingleByteCharacters ? std::optional(from_bytes(characters)) : std::nullopt;
}

}  // namespace earshot::hil
