#include "policy/own_search/template_text.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::own_search {
namespace {

/// Where the comment behind a value begins, with the space before it; the line's end where there is none.
std::size_t end_of_value(const std::string& line) {
  bool is_quoted = false;
  std::size_t end = line.size();
  for (std::size_t i = line.find('=') + 1; i < line.size() && end == line.size(); ++i) {
    if (line[i] == '"') is_quoted = !is_quoted;
    if (line[i] == '#' && !is_quoted) end = i;
  }
  return end;
}

/// Whether the key that `line` holds is `key`: "depth_m = 300.0".
bool holds(const std::string& line, std::string_view key) {
  if (!line.starts_with(key)) return false;
  const std::size_t behind = line.find_first_not_of(' ', key.size());
  return behind != std::string::npos && line[behind] == '=';
}

}  // namespace

TemplateText::TemplateText(std::string text, std::filesystem::path file) : file_(std::move(file)) {
  std::istringstream stream(std::move(text));
  for (std::string line; std::getline(stream, line);) lines_.push_back(line);
}

void TemplateText::set_heading(const std::string& comment) {
  lines_.erase(lines_.begin(), std::ranges::find(lines_, std::string()));
  lines_.insert(lines_.begin(), comment);
}

std::string& TemplateText::line_of(std::string_view table, std::string_view key) {
  const std::string head = "[" + std::string(table) + "]";
  bool is_in_table = table.empty();
  for (std::string& line : lines_) {
    if (line.starts_with("[")) is_in_table = line.starts_with(head);
    if (is_in_table && holds(line, key)) return line;
  }
  throw host::BadInput(file_.string() + ": has no key " + std::string(key) + " in " + head + ": is it of this version?");
}

void TemplateText::set(std::string_view table, std::string_view key, const std::string& value) {
  std::string& line = line_of(table, key);
  const std::size_t begin = line.find('=') + 2;
  const std::size_t comment = end_of_value(line);
  const std::string remark = line.substr(comment);
  line = line.substr(0, begin) + value;
  if (remark.empty()) return;
  line.resize(std::max(comment, line.size() + 1), ' ');
  line += remark;
}

std::string TemplateText::text() const {
  std::string text;
  for (const std::string& line : lines_) text += line + "\n";
  return text;
}

std::string toml_number(double value) {
  const std::string text = host::significant(value, std::numeric_limits<double>::digits10);
  const bool is_whole = text.find_first_of(".e") == std::string::npos;
  return text + (is_whole ? ".0" : "");
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace earshot::own_search
