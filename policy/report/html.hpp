#pragma once

#include <string>
#include <string_view>

#include "sim/plot/gnuplot.hpp"

namespace earshot::report {

/// From the doctype to the opened body: a page that needs no other file, light or dark as the reader has it.
[[nodiscard]] std::string html_head(const std::string& title);
inline constexpr std::string_view kHtmlEnd = "</body></html>\n";

using plot::escaped;

/// A `dt` and a `dd` in a box; belongs into a `dl`.
/// @param meaning  what name or value mean, in one line below; none
[[nodiscard]] std::string fact(std::string_view name, const std::string& value, const std::string& meaning = "");

/// A cell in percent whose background is a bar, as long as the cell where the share is one.
/// @param name  of its column, shown in the cell where a narrow screen has no room for the table's head
[[nodiscard]] std::string percent_cell(std::string_view name, double share, bool is_taken);

/// A cell with a bar from its middle to the right for what speaks for a choice, to the left for what speaks against it.
/// @param share  of the longest bar in the column, -1 to 1
[[nodiscard]] std::string signed_bar_cell(double share);

}  // namespace earshot::report
