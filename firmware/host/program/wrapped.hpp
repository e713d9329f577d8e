#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace earshot::program {

/// As wide as what programs say is at most: what a terminal commonly shows without breaking it itself.
inline constexpr std::size_t kWidestLine = 100;

/// A sentence broken between its words into lines of at most kWidestLine characters, without a line feed at its end; a longer word has a
/// line of its own.
/// @param column  where its first line begins: so much stands before it already
/// @param indent  blanks before its other lines
[[nodiscard]] std::string wrapped(std::string_view sentence, std::size_t column, std::size_t indent);

/// Each line of a text so, its other lines behind two blanks; with a line feed at the end of each.
[[nodiscard]] std::string wrapped_lines(std::string_view text);

}  // namespace earshot::program
