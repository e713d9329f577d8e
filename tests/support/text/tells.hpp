#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace earshot::support {

/// What a sentence is to name: files, keys, values, bounds, states, and words of the phrase books. How it is worded stays free.
using Facts = std::initializer_list<std::string_view>;

/// Whether a fact stands at `at` as a whole: "5" is none of "15", "0.5", "5.2" and "-5".
inline bool is_whole(std::string_view text, std::string_view fact, std::size_t at) {
  const auto of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const auto at_or = [text](std::size_t i) { return i < text.size() ? text[i] : ' '; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::size_t end = at + fact.size();
  const char before = at == 0 ? ' ' : text[at - 1];
  if (of_word(fact.front()) && of_word(before)) return false;
  if (is_digit(fact.front()) && (before == '-' || before == '.') && (at < 2 || !std::isalpha(static_cast<unsigned char>(text[at - 2]))))
    return false;
  if (of_word(fact.back()) && of_word(at_or(end))) return false;
  return !is_digit(fact.back()) || at_or(end) != '.' || !is_digit(at_or(end + 1));
}

/// The first fact that the text does not name behind those before it; none: it names all, in their order.
inline std::string_view first_untold(std::string_view text, Facts facts) {
  std::size_t from = 0;
  for (const std::string_view fact : facts) {
    if (fact.empty()) continue;
    std::size_t at = text.find(fact, from);
    while (at != std::string_view::npos && !is_whole(text, fact, at)) at = text.find(fact, at + 1);
    if (at == std::string_view::npos) return fact;
    from = at + fact.size();
  }
  return {};
}

inline std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

inline std::string_view last_line(std::string_view text) {
  const std::vector<std::string_view> lines = lines_of(text);
  return lines.empty() ? std::string_view() : lines.back();
}

/// Whether the text names all facts in this order.
[[nodiscard]] inline testing::AssertionResult tells(std::string_view text, Facts facts) {
  const std::string_view untold = first_untold(text, facts);
  if (untold.empty()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << untold << "\" is not told, or not in its place: " << text;
}

/// Whether one line of the text names all of them.
[[nodiscard]] inline testing::AssertionResult has_line(std::string_view text, Facts facts) {
  for (const std::string_view line : lines_of(text))
    if (first_untold(line, facts).empty()) return testing::AssertionSuccess();
  testing::AssertionResult failure = testing::AssertionFailure() << "no line tells";
  for (const std::string_view fact : facts) failure << " \"" << fact << "\"";
  return failure << ": " << text;
}

/// Whether there are just so many lines, each of which names its facts.
template <class Line>
[[nodiscard]] testing::AssertionResult lines_tell(const std::vector<Line>& lines, std::initializer_list<Facts> facts) {
  if (lines.size() != facts.size()) {
    testing::AssertionResult failure = testing::AssertionFailure() << lines.size() << " lines, not " << facts.size() << ":";
    for (const Line& line : lines) failure << "\n" << line;
    return failure;
  }
  std::size_t i = 0;
  for (const Facts of_line : facts)
    if (const testing::AssertionResult told = tells(lines[i++], of_line); !told) return told;
  return testing::AssertionSuccess();
}
[[nodiscard]] inline testing::AssertionResult lines_tell(std::string_view text, std::initializer_list<Facts> facts) {
  return lines_tell(lines_of(text), facts);
}

}  // namespace earshot::support
