#pragma once

#include <array>
#include <cstdio>
#include <span>
#include <string>

#include "firmware/wire/n2k/frame.hpp"
#include "tests/firmware/wire/golden/golden_file.hpp"

namespace earshot::wire {

/// "19ff8643#60", as candump writes a frame.
inline std::string text_of(const n2k::Frame& frame) {
  std::array<char, 16> identifier{};
  (void)std::snprintf(identifier.data(), identifier.size(), "%08x#", frame.identifier);
  return identifier.data() + hex(frame.bytes());
}

template <class Frames>
std::string text_of(const Frames& frames) {
  std::string text;
  for (const n2k::Frame& frame : frames) text += (text.empty() ? "" : " ") + text_of(frame);
  return text;
}

}  // namespace earshot::wire
