#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace earshot::host {

/// Text of another's making as a terminal may show it, on one line: what could steer a terminal or hide what is written is spelled out.
///
/// Spelled out are control characters (C0, DEL, C1: "\x1b", "\u0085"), marks that turn the direction of writing (U+200E, U+200F, U+202A to
/// U+202E, U+2066 to U+2069), and bytes that are not UTF-8 ("\xff"). All else stays as it is.
/// Source: RFC 3629 (UTF-8); ECMA-48 (control functions); Unicode Standard Annex 9 (directional formatting characters).
/// Oracle: Printable.*
[[nodiscard]] std::string printable(std::string_view text);

/// The same of text that has lines: they stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// A text of no more than `most` bytes as it is; of a longer one two thirds of that from its begin and a third from its end, where what is
/// said about a long name or value stands, and how much is left out between: "units are xxx... (999100 more bytes) ...xxx". No character of
/// UTF-8 is cut.
/// Oracle: Shortened.*
[[nodiscard]] std::string shortened(std::string_view text, std::size_t most);

/// A word of a file for a person, its underscores blanks: "left_area", "left area". Oracle: SpelledApart.*
[[nodiscard]] std::string spelled_apart(std::string word);

/// Source: RFC 3629.
/// Oracle: IsUtf8.*
[[nodiscard]] bool is_utf8(std::string_view text);

}  // namespace earshot::host
