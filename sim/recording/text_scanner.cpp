#include "sim/recording/text_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace earshot::recording {

TextScanner& TextScanner::fail() {
  is_ok_ = false;
  rest_ = {};
  return *this;
}

TextScanner& TextScanner::after(std::string_view word) {
  const std::size_t at = rest_.find(word);
  if (!is_ok_ || at == std::string_view::npos) return fail();
  rest_.remove_prefix(at + word.size());
  return *this;
}

TextScanner& TextScanner::word(std::string_view word) {
  if (!comes_next(word)) return fail();
  rest_.remove_prefix(word.size());
  return *this;
}

TextScanner& TextScanner::digits(std::size_t count, int& number) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::string_view text = rest_.substr(0, count);
  if (!is_ok_ || text.size() < count || !std::ranges::all_of(text, is_digit)) return fail();
  std::from_chars(text.data(), text.data() + count, number);
  rest_.remove_prefix(count);
  return *this;
}

TextScanner& TextScanner::integer(int& number) {
  if (!is_ok_) return fail();
  if (rest_.starts_with('+')) rest_.remove_prefix(1);
  int read = 0;
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + std::min<std::size_t>(rest_.size(), 10), read);
  if (error != std::errc{}) return fail();
  number = read;
  rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
  return *this;
}

TextScanner& TextScanner::decimal(double& number) {
  double read = 0.0;
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), read, std::chars_format::fixed);
  if (!is_ok_ || error != std::errc{} || !std::isfinite(read)) return fail();
  number = read;
  rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
  return *this;
}

TextScanner& TextScanner::blanks() {
  const std::size_t end = rest_.find_first_not_of(" \t");
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end);
  return *this;
}

}  // namespace earshot::recording
