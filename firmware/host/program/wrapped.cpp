#include "firmware/host/program/wrapped.hpp"

#include <algorithm>

namespace earshot::program {

std::string wrapped(std::string_view sentence, std::size_t column, std::size_t indent) {
  std::string text;
  bool begins_line = true;
  while (true) {
    const std::size_t begin = sentence.find_first_not_of(' ');
    if (begin == std::string_view::npos) return text;
    sentence.remove_prefix(begin);
    const std::string_view word = sentence.substr(0, sentence.find(' '));
    sentence.remove_prefix(word.size());
    if (!begins_line && column + 1 + word.size() > kWidestLine) {
      text += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!begins_line) {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
    begins_line = false;
  }
}

std::string wrapped_lines(std::string_view text) {
  constexpr std::size_t kIndent = 2;
  std::string lines;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    lines += wrapped(line, 0, kIndent) + "\n";
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return lines;
}

}  // namespace earshot::program
