#include "firmware/host/toml/nesting.hpp"

#include <algorithm>

namespace earshot::host {
namespace {

/// Where a text goes on after the string that begins it with one quotation mark or with three.
std::size_t after_string(std::string_view text) {
  const char quote = text.front();
  const bool has_lines = text.size() >= 3 && text[1] == quote && text[2] == quote;
  const std::string_view closing = text.substr(0, has_lines ? 3 : 1);
  for (std::size_t i = closing.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.substr(i).starts_with(closing)) {
      i += closing.size();
      for (int own = 0; has_lines && own < 2 && text.substr(i).starts_with(quote); ++own) ++i;  // two more may be the string's own
      return i;
    } else if (text[i] == '\n' && !has_lines) {
      return i;  // not TOML, which the parser says
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_nested_too_deep(std::string_view toml) {
  std::size_t open = 0;
  std::size_t dots = 0;  // since the key began
  for (std::size_t i = 0; i < toml.size(); ++i) {
    const char c = toml[i];
    if (c == '"' || c == '\'') {
      i += after_string(toml.substr(i)) - 1;
    } else if (c == '#') {
      i = std::min(toml.find('\n', i), toml.size()) - 1;
    } else if (c == '[' || c == '{') {
      ++open;
    } else if (c == ']' || c == '}') {
      open -= std::min<std::size_t>(open, 1);
    } else if (c == '.') {
      ++dots;
    } else if (c == '\n' || c == '=' || c == ',') {
      dots = 0;
    }
    if (open > kDeepestNesting || dots > kDeepestNesting)
      return 1 + static_cast<std::size_t>(std::count(toml.begin(), toml.begin() + static_cast<std::ptrdiff_t>(i), '\n'));
  }
  return std::nullopt;
}

}  // namespace earshot::host
