#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace earshot::host {

/// Deepest that arrays, inline tables and dotted keys may stand in each other; the deepest of ours is 3.
inline constexpr std::size_t kDeepestNesting = 32;

/// The line where a TOML text nests deeper than kDeepestNesting, from 1; nothing when it does not.
///
/// The brackets that are open and the dots of the key they stand in count together, at most 32 of each. The parser (toml++ 3.3) recurses
/// once for each dot of a key when it lets its tables go: a key of 40 000 dots ends the program.
/// Source: TOML 1.0.0, "String" and "Comment": what stands in them does not count.   Oracle: Nesting.*
[[nodiscard]] std::optional<std::size_t> line_nested_too_deep(std::string_view toml);

}  // namespace earshot::host
