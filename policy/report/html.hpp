#pragma once

#include <string>
#include <string_view>

namespace earshot::report {

/// From the doctype to the opened body: a page that needs no other file, light or dark as the reader has it.
[[nodiscard]] std::string html_head(const std::string& title);
inline constexpr std::string_view kHtmlEnd = "</body></html>\n";

[[nodiscard]] std::string escaped(std::string_view text);

/// "<dt>..<dd>" in a box; belongs into a <dl>.
[[nodiscard]] std::string fact(std::string_view name, const std::string& value);

/// A cell in percent whose background is a bar, `full_rem` long where the share is one.
[[nodiscard]] std::string percent_cell(double share, double full_rem, bool is_taken);

/// "47 min" or "1 h 12 min"
[[nodiscard]] std::string duration(double s);

}  // namespace earshot::report
