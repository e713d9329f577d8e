#pragma once

#include <optional>
#include <string>

#include "firmware/core/time.hpp"

namespace earshot::recording {

/// A date and a time of day as a calendar has them.
struct Calendar {
  int year = 1970;
  int month = 1;
  int day = 1;
  int hour = 0;
  int minute = 0;
  int second = 0;
};

/// Microseconds since 1970 in UTC; nothing where there is no such day or time, or a year outside 1970 to 2199.
[[nodiscard]] std::optional<Time> utc(const Calendar& calendar);

/// "2019-09-24T19:17:30.250Z"
[[nodiscard]] std::string to_iso(Time utc);

}  // namespace earshot::recording
