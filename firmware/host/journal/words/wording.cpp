#include "firmware/host/journal/words/wording.hpp"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <numbers>

namespace earshot::journal {
namespace {

std::string two_digits(unsigned number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

}  // namespace

bool is_dated(Time time) {
  using namespace std::chrono;
  constexpr Time kYear2000{
      microseconds(sys_days(year(2000) / January / 1).time_since_epoch()).count()};  // no simulated flight lasts so long
  constexpr Time kYear10000{microseconds(sys_days(year(10'000) / January / 1).time_since_epoch()).count()};
  return time >= kYear2000 && time < kYear10000;
}

std::string utc(Time time) {
  using namespace std::chrono;
  const sys_time<microseconds> instant{microseconds(time.us)};
  const sys_days day = floor<days>(instant);
  const year_month_day date{day};
  const hh_mm_ss clock{floor<seconds>(instant) - day};
  return std::to_string(static_cast<int>(date.year())) + "-" + two_digits(static_cast<unsigned>(date.month())) + "-" +
         two_digits(static_cast<unsigned>(date.day())) + " " + two_digits(static_cast<unsigned>(clock.hours().count())) + ":" +
         two_digits(static_cast<unsigned>(clock.minutes().count())) + ":" + two_digits(static_cast<unsigned>(clock.seconds().count())) +
         " UTC";
}

std::string decimal(double number, int places) {
  std::array<char, 400> digits{};  // 1.8e308 written out has 309
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed, places);
  return error == std::errc{} ? std::string(digits.data(), end) : "?";
}

std::string counted(std::uint64_t count, std::string_view what) {
  return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

std::string to_string(NorthEast place) {
  return decimal(place.north.value, 0) + " m north, " + decimal(place.east.value, 0) + " m east";
}

double seconds_of(Time time) {
  return static_cast<double>(time.us) / 1e6;
}

double compass_degrees(Radians heading) {
  constexpr double kFullTurn_deg = 360.0;
  const double degrees = std::fmod(heading.value * 180.0 / std::numbers::pi, kFullTurn_deg);
  const double turned = degrees < 0.0 ? degrees + kFullTurn_deg : degrees;
  return turned >= kFullTurn_deg ? 0.0 : turned;  // of an angle that is a rounding below zero
}

std::string compass(Radians heading, int places) {
  const double degrees = compass_degrees(heading);
  if (!std::isfinite(degrees)) return "";
  const std::string text = decimal(degrees, places);
  return text.starts_with("360") ? decimal(0.0, places) : text;
}

}  // namespace earshot::journal
