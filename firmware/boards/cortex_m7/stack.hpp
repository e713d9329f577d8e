#pragma once

#include <cstddef>

namespace earshot::stack {

/// Writes a pattern over all of the stack that is not in use. Called before main().
void paint();

/// How much of the stack has ever been in use since, bytes.
[[nodiscard]] std::size_t most_used();

/// All there is, bytes.
[[nodiscard]] std::size_t size();

}  // namespace earshot::stack
