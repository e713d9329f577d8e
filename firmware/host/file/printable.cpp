#include "firmware/host/file/printable.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace earshot::host {
namespace {

struct Character {
  std::size_t size = 0;  ///< bytes; 0: not UTF-8
  std::uint32_t code = 0;
};

std::uint32_t byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The first character of a text that is not empty.
Character first_of(std::string_view text) {
  constexpr std::array<std::uint32_t, 5> kLowest{0, 0, 0x80, 0x800, 0x10000};  // by size: what fits less bytes is not UTF-8
  const std::uint32_t lead = byte_at(text, 0);
  if (lead < 0x80) return {1, lead};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  std::uint32_t code = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte_at(text, i) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte_at(text, i) & 0x3FU);
  }
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < kLowest[size] || code > 0x10FFFF || is_surrogate ? Character{} : Character{size, code};
}

bool steers(std::uint32_t code) {
  const bool is_control = code < 0x20 || (code >= 0x7F && code <= 0x9F);
  const bool turns = code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return is_control || turns;
}

std::string spelled(const char* format, std::uint32_t number) {
  std::array<char, 16> text{};
  (void)std::snprintf(text.data(), text.size(), format, static_cast<unsigned>(number));
  return text.data();
}

std::string spelled(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  return code < 0x80 ? spelled("\\x%02x", code) : spelled("\\u%04x", code);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character c = first_of(text);
    if (c.size == 0) {
      shown += spelled("\\x%02x", byte_at(text, 0));
    } else if (steers(c.code)) {
      shown += spelled(c.code);
    } else {
      shown += text.substr(0, c.size);
    }
    text.remove_prefix(c.size == 0 ? 1 : c.size);
  }
  return shown;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const auto is_within_a_character = [text](std::size_t at) { return (byte_at(text, at) & 0xC0U) == 0x80U; };
  std::size_t end = most - most / 3;
  std::size_t begin = text.size() - most / 3;
  while (end > 0 && is_within_a_character(end)) --end;
  while (begin < text.size() && is_within_a_character(begin)) ++begin;
  return std::string(text.substr(0, end)) + "... (" + std::to_string(begin - end) + " more bytes) ..." + std::string(text.substr(begin));
}

std::string spelled_apart(std::string word) {
  std::ranges::replace(word, '_', ' ');
  return word;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = first_of(text).size;
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

std::string printable_lines(std::string_view text) {
  std::string shown;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    shown += printable(text.substr(0, end)) + "\n";
    text.remove_prefix(end + 1);
  }
  return shown + printable(text);
}

}  // namespace earshot::host
