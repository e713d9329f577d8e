#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace earshot::hil {

/// The text of variable size at the beginning of `bytes`, which move behind it: its size in bytes, its encoding (0: UTF-16, 1: one byte a
/// character), its characters. (The vehicle reads one byte a character only: n2k::take_variable_text.)
/// @param bytes  not empty. Behind a size that no text has nobody knows where the next one would begin: they become empty.
/// @return UTF-8 of what was UTF-16, else any bytes; empty: there is none. Nothing: such a size, or another encoding.
/// Source: canboat's documentation of STRING_LAU (Apache-2.0); RFC 2781 (UTF-16); RFC 3629 (UTF-8).   Oracle: TextOfABus tests
[[nodiscard]] std::optional<std::string> take_text(std::span<const std::uint8_t>& bytes);

}  // namespace earshot::hil
