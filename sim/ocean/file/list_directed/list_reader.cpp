#include "sim/ocean/file/list_directed/list_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "firmware/host/text/numbers.hpp"

namespace earshot::ocean {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

bool is_separator(char c) {
  return is_blank(c) || c == '\n' || c == ',' || c == '/';
}

/// Fortran's exponents are D too, and it allows a sign before a number.
std::optional<double> finite_number(std::string text) {
  for (char& c : text) c = c == 'd' || c == 'D' ? 'e' : c;
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  const bool has_two_signs = sign == 1 && text.size() > 1 && text[1] == '-';
  if (error != std::errc() || has_two_signs || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// "3*0.5" is a value and how often it stands; the value may be missing.
struct Repeated {
  std::size_t times = 1;
  std::string value;
};

Repeated repeated(const std::string& text) {
  const std::size_t star = text.find('*');
  Repeated result{1, text};
  if (star == std::string::npos || star == 0) return result;
  std::size_t times = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + star, times);
  if (error != std::errc() || end != text.data() + star || times == 0) return result;
  return {times, text.substr(star + 1)};
}

std::string trimmed(const std::string& text) {
  const char* const blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace

ListReader::ListReader(const std::filesystem::path& path) : ListReader(path, host::read_text(path, kModelFile)) {}

ListReader::ListReader(std::filesystem::path path, std::string text) : path_(std::move(path)), text_(std::move(text)) {}

host::BadInput ListReader::error(const std::string& what, const std::string& value, const std::string& must) const {
  return host::BadInput(path_.string() + ":" + std::to_string(line_) + ": " + what + " = " + value + ": " + must);
}

host::BadInput ListReader::error(const std::string& what, double value, const std::string& must) const {
  return error(what, host::shortest(value), must);
}

void ListReader::require(const std::string& what, double value, host::Range allowed) const {
  if (!allowed.allows(value)) throw error(what, value, to_string(allowed));
}

bool ListReader::at_end() const {
  return text_.find_first_not_of(" \t\r\n", at_) == std::string::npos;
}

void ListReader::begin() {
  after_comma_ = true;
}

void ListReader::end_of_read() {
  const std::size_t end = text_.find('\n', at_);
  if (end != std::string::npos) ++next_line_;
  at_ = end == std::string::npos ? text_.size() : end + 1;
}

void ListReader::skip_blanks() {
  for (; at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '\n'); ++at_) next_line_ += text_[at_] == '\n' ? 1 : 0;
}

std::string ListReader::quoted(const std::string& what) {
  const char quote = text_[at_++];
  std::string content;
  while (at_ < text_.size() && text_[at_] != '\n') {
    if (text_[at_] != quote) {
      content += text_[at_++];
    } else if (at_ + 1 < text_.size() && text_[at_ + 1] == quote) {  // a quote within the text stands twice
      content += quote;
      at_ += 2;
    } else {
      ++at_;
      return content;
    }
  }
  throw error(what, content, "must end with a quote on its line");
}

std::optional<ListReader::Item> ListReader::next_item(const std::string& what) {
  for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
    line_ = next_line_;
    const char c = text_[at_];
    if (c == '/') return std::nullopt;
    if (c == ',') {
      ++at_;
      if (std::exchange(after_comma_, true)) return Item{.text = {}, .is_quoted = false, .is_null = true};
      continue;
    }
    after_comma_ = false;
    if (c == '\'' || c == '"') return Item{.text = quoted(what), .is_quoted = true, .is_null = false};
    const auto end = std::find_if(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(), is_separator);
    std::string word(text_.begin() + static_cast<std::ptrdiff_t>(at_), end);
    at_ += word.size();
    return Item{.text = std::move(word), .is_quoted = false, .is_null = false};
  }
  throw error(what, "nothing", "the file ends too early");
}

std::size_t ListReader::numbers(std::span<double> values, const std::string& what) {
  begin();
  std::size_t read = 0;
  while (read < values.size()) {
    const std::optional<Item> item = next_item(what);
    if (!item) break;
    if (item->is_null) {
      ++read;
      continue;
    }
    const Repeated number = repeated(item->text);
    const std::size_t times = std::min(number.times, values.size() - read);
    if (!number.value.empty()) {
      const std::optional<double> value = finite_number(number.value);
      if (!value || item->is_quoted) throw error(what, item->text, "must be a finite number");
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(read), times, *value);
    }
    read += times;
  }
  end_of_read();
  return read;
}

double ListReader::number(const std::string& what, host::Range allowed) {
  double value = std::numeric_limits<double>::quiet_NaN();
  numbers({&value, 1}, what);
  if (std::isnan(value)) throw error(what, "nothing", "must be a number");
  require(what, value, allowed);
  return value;
}

std::size_t ListReader::count(const std::string& what, std::size_t least, std::size_t most) {
  const double value = number(what, host::Range::between(static_cast<double>(least), static_cast<double>(most)));
  if (value != std::floor(value)) throw error(what, value, "must be a whole number");
  return static_cast<std::size_t>(value);
}

std::string ListReader::text_and_numbers(const std::string& what, std::span<double> values) {
  begin();
  const std::optional<Item> item = next_item(what);
  if (!item || item->is_null) throw error(what, "nothing", "must be a text");
  for (double& value : values) {
    const std::optional<Item> number = next_item(what);
    if (!number) break;
    if (number->is_null) continue;
    const std::optional<double> read = finite_number(number->text);
    if (!read) throw error("the number behind " + what, number->text, "must be a finite number");
    value = *read;
  }
  end_of_read();
  return item->text;
}

std::string ListReader::text(const std::string& what) {
  return text_and_numbers(what, {});
}

std::string ListReader::line(const std::string& what) {
  line_ = next_line_;
  if (at_ >= text_.size()) throw error(what, "nothing", "the file ends too early");
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string content = trimmed(text_.substr(at_, end - at_));
  end_of_read();
  if (content.empty() || (content.front() != '\'' && content.front() != '"')) return content;
  const std::size_t closing = content.find(content.front(), 1);
  return closing == std::string::npos ? content.substr(1) : content.substr(1, closing - 1);
}

std::size_t ListReader::numbers_ahead() const {
  const std::size_t first = text_.find_first_not_of(" \t\r\n", at_);
  if (first == std::string::npos) return 0;
  const std::string ahead = text_.substr(first, text_.find('\n', first) - first);
  std::size_t numbers = 0;
  for (std::size_t from = 0; from < ahead.size();) {
    const auto end = std::find_if(ahead.begin() + static_cast<std::ptrdiff_t>(from), ahead.end(), is_separator);
    const auto to = static_cast<std::size_t>(end - ahead.begin());
    if (to > from) {
      if (!finite_number(ahead.substr(from, to - from))) break;
      ++numbers;
    }
    if (to < ahead.size() && ahead[to] == '/') break;
    from = to + 1;
  }
  return numbers;
}

}  // namespace earshot::ocean
