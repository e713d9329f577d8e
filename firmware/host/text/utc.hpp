#pragma once

#include <string>

#include "firmware/core/time.hpp"

namespace earshot::host {

/// A date as calendars and clocks have it, in UTC.
struct CivilTime {
  int year = 1970;
  unsigned month = 1;  ///< 1 to 12
  unsigned day = 1;    ///< 1 to 31
  unsigned hour = 0;
  unsigned minute = 0;
  unsigned second = 0;
  unsigned millisecond = 0;
};
/// What is left over of a millisecond is cut off. It asks for no memory.
[[nodiscard]] CivilTime civil_time(Time time);

/// Whether a clock that gives this is one of dates; a simulator's begins at 0.
[[nodiscard]] bool is_dated(Time time);

/// "2026-11-22 15:04:07"
[[nodiscard]] std::string date_and_time(Time time);

/// "2026-11-22T15:04:07.250Z"; what is left over of a millisecond is cut off.
[[nodiscard]] std::string iso_8601(Time time);

}  // namespace earshot::host
