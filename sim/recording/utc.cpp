#include "sim/recording/utc.hpp"

#include <array>
#include <chrono>
#include <cstdio>

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
  using namespace std::chrono;
  const sys_time<milliseconds> instant{round<milliseconds>(microseconds{utc.us})};
  const auto midnight = floor<days>(instant);
  const year_month_day date{midnight};
  const hh_mm_ss clock{instant - midnight};
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(date.year()),
                                 static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                                 static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                                 static_cast<int>(clock.seconds().count()), static_cast<int>(clock.subseconds().count()));
  return {text.data(), static_cast<std::size_t>(size)};
}

}  // namespace earshot::recording
