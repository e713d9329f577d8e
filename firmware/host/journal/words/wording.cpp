#include "firmware/host/journal/words/wording.hpp"

#include <cmath>

#include "firmware/core/compass.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/utc.hpp"

namespace earshot::journal {

std::string utc(Time time) {
  return host::date_and_time(time) + " UTC";
}

std::string to_string(NorthEast place) {
  return host::decimals(place.north.value, 0) + " m north, " + host::decimals(place.east.value, 0) + " m east";
}

double seconds_of(Time time) {
  return static_cast<double>(time.us) / 1e6;
}

std::string compass(Radians heading, int places) {
  const double degrees = compass_degrees(heading);
  if (!std::isfinite(degrees)) return "";
  const std::string text = host::decimals(degrees, places);
  return text.starts_with("360") ? host::decimals(0.0, places) : text;
}

}  // namespace earshot::journal
