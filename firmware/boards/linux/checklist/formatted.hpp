#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace earshot::board {

/// What std::printf would print, up to 511 characters.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 512> text{};
  (void)std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace earshot::board
