#include "sim/recording/utc.hpp"

#include <chrono>

#include "firmware/host/text/utc.hpp"

namespace earshot::recording {

std::optional<Time> utc(const Calendar& c) {
  using namespace std::chrono;
  const year_month_day date{year{c.year}, month{static_cast<unsigned>(c.month)}, day{static_cast<unsigned>(c.day)}};
  const auto is_within = [](int value, int lowest, int highest) { return value >= lowest && value <= highest; };
  if (!is_within(c.year, 1970, 2199) || !is_within(c.month, 1, 12) || !is_within(c.day, 1, 31) || !date.ok()) return std::nullopt;
  if (!is_within(c.hour, 0, 23) || !is_within(c.minute, 0, 59) || !is_within(c.second, 0, 59)) return std::nullopt;
  const auto instant = sys_days{date} + hours{c.hour} + minutes{c.minute} + seconds{c.second};
  return Time{duration_cast<microseconds>(instant.time_since_epoch()).count()};
}

std::string to_iso(Time utc) {
  constexpr std::int64_t kHalfMillisecond_us = 500;
  return host::iso_8601(Time{utc.us + kHalfMillisecond_us});
}

}  // namespace earshot::recording
