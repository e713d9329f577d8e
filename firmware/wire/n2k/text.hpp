#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/table/signal.hpp"

namespace earshot::n2k {

// Text on the bus: of fixed size, padded with 0xFF (others pad with zeros, blanks or '@'), or of variable size: a byte that counts itself,
// the encoding and the characters; the encoding, 1 for one byte a character; the characters.
// Source: canboat's documentation of STRING_FIX and STRING_LAU (Apache-2.0).   Oracle: Text tests; the peer test against PyPI's nmea2000

/// Characters of a field of fixed size, without its padding; they live in `bytes`.
/// @return kMalformed: too few bytes, or no field of text. kNotReady: none are there.
[[nodiscard]] Result<std::string_view> fixed_text(const Signal& signal, std::span<const std::uint8_t> bytes);

/// kOutOfRange, and nothing written, if the text is longer than its field or holds what is not printable ASCII. kFull: too few bytes.
[[nodiscard]] Status write_fixed_text(const Signal& signal, std::string_view text, std::span<std::uint8_t> bytes);

/// The text at the beginning of `bytes`, which move behind it.
/// @return kMalformed: a size that no text has, or too few bytes. kUnsupported: two bytes a character. kNotReady: an empty text.
[[nodiscard]] Result<std::string_view> take_variable_text(std::span<const std::uint8_t>& bytes);

/// Writes a text at the beginning of `bytes`, which move behind it. kOutOfRange: over 253 characters, or not printable ASCII. kFull: too
/// few bytes.
[[nodiscard]] Status put_variable_text(std::string_view text, std::span<std::uint8_t>& bytes);

}  // namespace earshot::n2k
