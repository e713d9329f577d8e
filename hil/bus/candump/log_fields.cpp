#include "hil/bus/candump/log_fields.hpp"

#include <algorithm>
#include <ctime>

namespace earshot::hil {

namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::int64_t kMicroseconds = 1'000'000;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::optional<std::tm> calendar(const DateParts& parts) {
  const bool is_date = parts[0] >= 1900 && parts[0] <= 9999 && parts[1] >= 1 && parts[1] <= 12 && parts[2] >= 1 && parts[2] <= 31;
  const bool is_time = parts[3] >= 0 && parts[3] < 24 && parts[4] >= 0 && parts[4] <= 59 && parts[5] >= 0 && parts[5] <= 60;
  if (!is_date || !is_time) return std::nullopt;
  std::tm date{};
  date.tm_year = parts[0] - 1900;
  date.tm_mon = parts[1] - 1;
  date.tm_mday = parts[2];
  date.tm_hour = parts[3];
  date.tm_min = parts[4];
  date.tm_sec = parts[5];
  date.tm_isdst = -1;
  return date;
}

}  // namespace

std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return word;
}

std::string_view take_field(std::string_view& text, char separator) {
  const std::string_view field = text.substr(0, text.find(separator));
  text.remove_prefix(std::min(field.size() + 1, text.size()));
  return field;
}

std::optional<std::uint8_t> byte(std::string_view digits) {
  return digits.size() == 2 ? number<std::uint8_t>(digits, 16) : std::nullopt;
}

std::optional<std::int64_t> scaled(std::string_view decimal, unsigned power) {
  constexpr std::int64_t kMost = 100'000'000'000'000'000;
  std::string_view part = decimal;
  const std::string_view whole = take_field(part, '.');
  if (whole.empty() || !std::ranges::all_of(whole, is_digit) || !std::ranges::all_of(part, is_digit)) return std::nullopt;
  std::int64_t value = 0;
  const auto push = [&value](char digit) { value = value > kMost / 10 ? kMost : 10 * value + (digit - '0'); };
  std::ranges::for_each(whole, push);
  for (unsigned i = 0; i < power; ++i) push(i < part.size() ? part[i] : '0');
  return value < kMost ? std::optional(value) : std::nullopt;
}

std::optional<DateParts> date_parts(std::string_view text, std::string_view shape) {
  if (text.size() != shape.size()) return std::nullopt;
  DateParts parts{};
  std::size_t part = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (shape[i] != '0' ? text[i] != shape[i] : !is_digit(text[i])) return std::nullopt;
    if (shape[i] != '0' && i > 0 && shape[i - 1] == '0') ++part;
    if (shape[i] == '0') parts.at(part) = 10 * parts.at(part) + (text[i] - '0');
  }
  return parts;
}

std::optional<Time> local_time(const DateParts& parts) {
  auto date = calendar(parts);
  if (!date || parts[0] < 1970) return std::nullopt;
  return Time{std::mktime(&*date) * kMicroseconds};
}

std::optional<Time> utc_time(const DateParts& parts) {
  auto date = calendar(parts);
  if (!date) return std::nullopt;
  return Time{::timegm(&*date) * kMicroseconds};
}

}  // namespace earshot::hil
