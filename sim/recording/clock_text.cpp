#include "sim/recording/clock_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/recording/utc.hpp"

namespace earshot::recording {
namespace {

constexpr int kFarthestZone_h = 14;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t digits_ahead(const TextScanner& text) {
  return static_cast<std::size_t>(std::ranges::find_if_not(text.rest(), is_digit) - text.rest().begin());
}

/// Digits behind a point, as many as stand there.
Duration read_fraction(TextScanner& text) {
  std::int64_t us = 0;
  std::int64_t unit_us = 100'000;
  for (std::size_t left = digits_ahead(text); left > 0; --left, unit_us /= 10) {
    int digit = 0;
    text.digits(1, digit);
    us += digit * unit_us;
  }
  return {us};
}

/// Passes over one of these letters. @return it; nothing where none comes next
std::optional<char> one_of(TextScanner& text, std::string_view letters) {
  if (!text.is_ok() || text.rest().empty() || letters.find(text.rest().front()) == std::string_view::npos) return std::nullopt;
  const char letter = text.rest().front();
  text.word(text.rest().substr(0, 1));
  return letter;
}

/// Behind the sign: "4", "10", "1000", "930", "5:30". Leaves nothing of its digits.
std::optional<Duration> read_offset(TextScanner& text) {
  int hours = 0;
  int minutes = 0;
  const std::size_t count = digits_ahead(text);
  if (count < 1 || count > 4) return std::nullopt;
  text.digits(count > 2 ? count - 2 : count, hours);
  if (count > 2)
    text.digits(2, minutes);
  else if (text.comes_next(":"))
    text.word(":").digits(2, minutes);
  const int all_minutes = 60 * hours + minutes;
  if (!text.is_ok() || minutes > 59 || all_minutes > 60 * kFarthestZone_h) return std::nullopt;
  return Duration::seconds(60LL * all_minutes);
}

/// In a name "-1", "-0017" or "-0015" behind a time may be a part's number: a zone has four digits there, minutes that a zone has, and an
/// hour at least if it is west of UTC.
bool is_zone_of_name(std::string_view zone) {
  if (zone == "Z" || zone == "z" || zone.starts_with("UTC") || zone.starts_with("GMT")) return true;
  const std::string_view digits = zone.substr(1);
  if (digits.size() == 2) return zone.front() == '+';
  const std::string_view minutes = digits.size() >= 4 ? digits.substr(digits.size() - 2) : std::string_view();
  if (zone.front() == '-' && digits.starts_with("00")) return false;
  return minutes == "00" || minutes == "15" || minutes == "30" || minutes == "45";
}

ClockTime with_zone_of_name(Time clock, TextScanner text) {
  if (text.comes_next("_+") || text.comes_next("_-")) text.word("_");
  const std::string_view before = text.rest();
  const std::optional<Duration> zone = read_zone(text);
  const bool is_zone = zone && is_zone_of_name(before.substr(0, before.size() - text.rest().size()));
  const auto is_letter = [](char c) { return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (!is_zone || (!text.rest().empty() && is_letter(text.rest().front()))) return {.utc = clock, .has_zone = false};
  return {.utc = Time{clock.us - zone->us}, .has_zone = true};
}

/// At the front of a text.
std::optional<ClockTime> time_at_front(std::string_view name) {
  Calendar c;
  TextScanner text(name);
  text.digits(4, c.year);
  const std::optional<char> parts_date = one_of(text, "-_.");
  const std::string_view between = parts_date ? std::string_view(&name[4], 1) : std::string_view();
  text.digits(2, c.month).word(between).digits(2, c.day);
  const std::optional<char> parts_time = one_of(text, "_Tt- .$");
  if (parts_date && !parts_time) return std::nullopt;
  text.digits(2, c.hour);
  const std::string_view before_minute = text.rest();
  const std::string_view colon = parts_time && one_of(text, "-_:.") ? before_minute.substr(0, 1) : std::string_view();
  text.digits(2, c.minute).word(colon).digits(2, c.second);
  std::optional<Time> clock = text.is_ok() ? utc(c) : std::nullopt;
  if (!clock) return std::nullopt;
  const std::size_t more = digits_ahead(text);
  if (more != 0 && more != 3 && more != 6) return std::nullopt;
  TextScanner point = text;
  if (more > 0)
    clock->us += read_fraction(text).us;
  else if (point.comes_next(".") && digits_ahead(point.word(".")) > 0) {
    clock->us += read_fraction(point).us;
    text = point;
  }
  return with_zone_of_name(*clock, text);
}

/// A pattern's fields as they were read.
struct Fields {
  Calendar calendar;
  std::optional<int> day_of_year;
  Duration fraction;
  std::optional<Duration> zone;
};

bool read_field(char field, TextScanner& text, Fields& fields) {
  Calendar& c = fields.calendar;
  int day = 0;
  switch (field) {
    case 'Y':
      return text.digits(4, c.year).is_ok();
    case 'y':
      text.digits(2, c.year);
      c.year += c.year < 70 ? 2000 : 1900;
      return text.is_ok();
    case 'm':
      return text.digits(2, c.month).is_ok();
    case 'd':
      return text.digits(2, c.day).is_ok();
    case 'j':
      fields.day_of_year = text.digits(3, day).is_ok() ? day : 0;
      return text.is_ok() && day >= 1 && day <= 366;
    case 'H':
      return text.digits(2, c.hour).is_ok();
    case 'M':
      return text.digits(2, c.minute).is_ok();
    case 'S':
      return text.digits(2, c.second).is_ok();
    case 'f':
      if (digits_ahead(text) == 0) return false;
      fields.fraction = read_fraction(text);
      return true;
    case 'z':
      fields.zone = read_zone(text);
      return fields.zone.has_value();
    default:
      return text.word(std::string_view(&field, 1)).is_ok();
  }
}

std::optional<ClockTime> by_format_at_front(std::string_view format, std::string_view name) {
  Fields fields;
  TextScanner text(name);
  for (std::size_t i = 0; i < format.size(); ++i) {
    const bool is_field = format[i] == '%' && format[i + 1] != '%';
    if (format[i] == '%') ++i;
    if (is_field ? !read_field(format[i], text, fields) : !text.word(format.substr(i, 1)).is_ok()) return std::nullopt;
  }
  std::optional<Time> clock = utc(fields.calendar);
  if (!clock) return std::nullopt;
  if (fields.day_of_year) clock->us += Duration::seconds(86'400LL * (*fields.day_of_year - 1)).us;
  return ClockTime{.utc = Time{clock->us + fields.fraction.us - fields.zone.value_or(Duration{}).us}, .has_zone = fields.zone.has_value()};
}

}  // namespace

std::optional<Duration> read_zone(TextScanner& text) {
  bool is_named = false;
  for (const std::string_view word : {"Z", "z", "UTC", "GMT"}) {
    if (is_named || !text.comes_next(word)) continue;
    text.word(word);
    is_named = true;
  }
  const std::optional<char> sign = one_of(text, "+-");
  if (!sign) return is_named ? std::optional(Duration{}) : std::nullopt;
  const std::optional<Duration> offset = read_offset(text);
  return offset && *sign == '-' ? std::optional(Duration{-offset->us}) : offset;
}

std::optional<ClockTime> read_iso(std::string_view iso) {
  Calendar c;
  TextScanner text(iso.substr(0, iso.find('\0')));
  text.blanks().digits(4, c.year);
  const std::string_view rest = text.rest();
  const std::string_view between = one_of(text, "-/:") ? rest.substr(0, 1) : std::string_view();
  text.digits(2, c.month).word(between).digits(2, c.day);
  if (!one_of(text, "T ")) return std::nullopt;
  const std::string_view colon = between.empty() ? std::string_view() : std::string_view(":");  // the basic format has neither
  text.digits(2, c.hour).word(colon).digits(2, c.minute);
  Duration fraction;
  if (colon.empty() ? digits_ahead(text) == 2 : text.comes_next(colon)) {
    text.word(colon).digits(2, c.second);
    if (one_of(text, ".,")) fraction = read_fraction(text);
  }
  const std::optional<Time> clock = text.is_ok() ? utc(c) : std::nullopt;
  if (!clock) return std::nullopt;
  std::optional<Duration> zone;
  const bool has_zone = !text.blanks().rest().empty() && text.rest().find_first_not_of(" \t\r\n") != std::string_view::npos;
  if (has_zone) zone = read_zone(text);
  if (has_zone && (!zone || text.rest().find_first_not_of(" \t\r\n") != std::string_view::npos)) return std::nullopt;
  return ClockTime{.utc = Time{clock->us + fraction.us - zone.value_or(Duration{}).us}, .has_zone = has_zone};
}

std::optional<ClockTime> time_in_name(std::string_view name) {
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (!is_digit(name[at]) || (at > 0 && is_digit(name[at - 1]))) continue;
    if (const std::optional<ClockTime> time = time_at_front(name.substr(at))) return time;
  }
  return std::nullopt;
}

std::optional<ClockTime> time_by_format(std::string_view format, std::string_view name) {
  for (std::size_t at = 0; at < name.size(); ++at)
    if (const std::optional<ClockTime> time = by_format_at_front(format, name.substr(at))) return time;
  return std::nullopt;
}

std::string fault_of_iso(std::string_view text) {
  return read_iso(text) ? "" : "is no time such as 2021-02-05T03:59:46Z or 2021-02-05T03:59:46+10:00";
}

std::string fault_of_format(std::string_view format) {
  std::string fields;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') continue;
    if (++i == format.size() || std::string_view("YymdjHMSfz%").find(format[i]) == std::string_view::npos)
      return "takes %Y %y %m %d %j %H %M %S %f %z and %%";
    fields += format[i];
  }
  const auto has = [&fields](char field) { return fields.find(field) != std::string::npos; };
  const bool is_dated = (has('Y') || has('y')) && (has('j') || (has('m') && has('d')));
  return is_dated && has('H') ? "" : "must have the year (%Y or %y), the day (%m and %d, or %j) and the hour (%H)";
}

}  // namespace earshot::recording
