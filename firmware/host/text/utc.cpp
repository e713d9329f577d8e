#include "firmware/host/text/utc.hpp"

#include <chrono>

#include "firmware/host/text/numbers.hpp"

namespace earshot::host {

CivilTime civil_time(Time time) {
  using namespace std::chrono;
  const sys_time<microseconds> instant{microseconds(time.us)};
  const sys_days midnight = floor<days>(instant);
  const year_month_day date{midnight};
  const hh_mm_ss clock{floor<milliseconds>(instant) - midnight};
  return {.year = static_cast<int>(date.year()),
          .month = static_cast<unsigned>(date.month()),
          .day = static_cast<unsigned>(date.day()),
          .hour = static_cast<unsigned>(clock.hours().count()),
          .minute = static_cast<unsigned>(clock.minutes().count()),
          .second = static_cast<unsigned>(clock.seconds().count()),
          .millisecond = static_cast<unsigned>(clock.subseconds().count())};
}

bool is_dated(Time time) {
  using namespace std::chrono;
  constexpr Time kYear2000{
      microseconds(sys_days(year(2000) / January / 1).time_since_epoch()).count()};  // no simulated flight lasts so long
  constexpr Time kYear10000{microseconds(sys_days(year(10'000) / January / 1).time_since_epoch()).count()};
  return time >= kYear2000 && time < kYear10000;
}

std::string date_and_time(Time time) {
  const CivilTime t = civil_time(time);
  return formatted("%d-%02u-%02u %02u:%02u:%02u", t.year, t.month, t.day, t.hour, t.minute, t.second);
}

std::string iso_8601(Time time) {
  const CivilTime t = civil_time(time);
  return formatted("%04d-%02u-%02uT%02u:%02u:%02u.%03uZ", t.year, t.month, t.day, t.hour, t.minute, t.second, t.millisecond);
}

}  // namespace earshot::host
