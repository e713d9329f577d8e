#pragma once

#include <string>
#include <string_view>

namespace earshot::evaluate {

/// A text as one cell of a CSV line: quoted where it must be, as it is elsewhere.
/// Source: RFC 4180, section 2, rules 5 to 7
[[nodiscard]] std::string csv_cell(std::string_view text);

}  // namespace earshot::evaluate
