#include "policy/explain/wording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "firmware/core/compass.hpp"
#include "firmware/core/math.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::explain {
namespace {

using policy::Feature;

constexpr double kFullTurn_deg = 360.0;
constexpr double kDegreesPerPoint = 22.5;

enum class Unit : std::uint8_t { kMeters, kDecibels, kShare, kCount };

Unit unit_of(Feature feature) {
  switch (feature) {
    case Feature::kStepSnr:
      return Unit::kDecibels;
    case Feature::kLikeliestShare:
    case Feature::kFound:
    case Feature::kFindProbability:
    case Feature::kDetected:
      return Unit::kShare;
    case Feature::kEffectiveCells:
    case Feature::kBorder:
    case Feature::kRegret:
    case Feature::kPreference:
      return Unit::kCount;
    default:
      return Unit::kMeters;
  }
}

std::string steps_ago(unsigned age) {
  if (age == 0) return "over the last step";
  return age == 1 ? "over the step before" : std::to_string(age) + " steps earlier";
}

std::string heard_when(unsigned age) {
  if (age == 0) return "SNR heard now";
  return age == 1 ? "SNR heard one step ago" : "SNR heard " + std::to_string(age) + " steps ago";
}

constexpr const char* kTimes = "\u00D7 ";

/// "20 000"
std::string grouped(long number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, "\u202F");
  return digits;
}

/// An exponent as it stands beside a ten.
std::string superscript(int power) {
  constexpr std::array<const char*, 10> kDigits{"\u2070", "\u00B9", "\u00B2", "\u00B3", "\u2074",
                                                "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string text = power < 0 ? "\u207B" : "";
  for (const char digit : std::to_string(std::abs(power))) text += kDigits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

Subject subject_of(Feature feature) {
  switch (feature) {
    case Feature::kStepEast:
    case Feature::kStepNorth:
      return Subject::kMoved;
    case Feature::kStepSnr:
      return Subject::kHeard;
    case Feature::kFound:
    case Feature::kDetected:
    case Feature::kFindProbability:
    case Feature::kBorder:
    case Feature::kRegret:
    case Feature::kPreference:
    case Feature::kApproach:
      return Subject::kPromised;
    default:
      return policy::needs_belief(feature) ? Subject::kBelieved : Subject::kPlace;
  }
}

std::string_view to_string(Subject subject) {
  constexpr std::array<std::string_view, 5> kWords{"where the vehicle is", "how it moved", "what it heard",
                                                   "where the source is believed to be", "what each direction promises"};
  return kWords[static_cast<std::size_t>(subject)];
}

bool uses_measurements(const policy::ObservationSpec& spec) {
  return std::ranges::any_of(spec, [](const policy::ObservationElement& element) {
    const Subject subject = subject_of(element.feature);
    return subject != Subject::kPlace && subject != Subject::kMoved;
  });
}

std::string degrees_to_string(Radians bearing) {
  return host::formatted("%03.0f\u00B0", std::fmod(std::round(compass_degrees(bearing)), kFullTurn_deg));
}

std::string compass_point(Radians bearing) {
  constexpr std::array<std::string_view, 16> kPoints{"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                     "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  const double point = std::round(compass_degrees(bearing) / kDegreesPerPoint);
  return std::string(kPoints[static_cast<std::size_t>(point) % kPoints.size()]);
}

std::string direction_name(const UnitNorthEast& direction) {
  const Radians bearing = bearing_of(direction.north, direction.east);
  const double point = compass_degrees(bearing) / kDegreesPerPoint;
  return std::abs(point - std::round(point)) < 1e-6 ? compass_point(bearing) : degrees_to_string(bearing);
}

std::string name_of(const policy::ObservationElement& element, const FixedVector<UnitNorthEast, config::kMaxActions>& actions) {
  const auto going = [&](const char* what) {
    return std::string(what) + " " + (element.age < actions.size() ? direction_name(actions[element.age]) : std::to_string(element.age));
  };
  switch (element.feature) {
    case Feature::kEast:
      return "vehicle east of the west edge";
    case Feature::kNorth:
      return "vehicle north of the south edge";
    case Feature::kStepEast:
      return "went east " + steps_ago(element.age);
    case Feature::kStepNorth:
      return "went north " + steps_ago(element.age);
    case Feature::kStepSnr:
      return heard_when(element.age);
    case Feature::kToSouthEdge:
      return "distance to the south edge";
    case Feature::kToNorthEdge:
      return "distance to the north edge";
    case Feature::kToWestEdge:
      return "distance to the west edge";
    case Feature::kToEastEdge:
      return "distance to the east edge";
    case Feature::kLikeliestEast:
      return "likeliest place, east of the vehicle";
    case Feature::kLikeliestNorth:
      return "likeliest place, north of the vehicle";
    case Feature::kMeanEast:
      return "mean place, east of the vehicle";
    case Feature::kMeanNorth:
      return "mean place, north of the vehicle";
    case Feature::kSpread:
      return "spread of the believed place";
    case Feature::kLikeliestShare:
      return "chance of the likeliest place";
    case Feature::kEffectiveCells:
      return "cells that the belief is spread over";
    case Feature::kFound:
      return going("chance of finding the source by going");
    case Feature::kDetected:
      return going("chance of hearing it by going");
    case Feature::kFindProbability:
      return going("chance of finding it within a few steps, first going");
    case Feature::kBorder:
      return going("depth in the border by going");
    case Feature::kRegret:
      return going("expected extra cost of the search by going");
    case Feature::kPreference:
      return going("action value (1 the best, 0 the worst) of going");
    case Feature::kApproach:
      return going("nearer to the likeliest place by going");
    default:
      break;
  }
  return "feature " + std::to_string(static_cast<int>(element.feature));
}

std::string value_of(const policy::ObservationElement& element, float value) {
  const double scale = static_cast<double>(element.scale);
  if (scale == 0.0) return "-";
  const double raw = static_cast<double>(value) / scale + static_cast<double>(element.offset);
  switch (unit_of(element.feature)) {
    case Unit::kMeters:
      return fixed(raw / 1e3, 2) + " km";
    case Unit::kDecibels:
      return fixed(raw, 1) + " dB";
    case Unit::kShare:
      return fixed(100.0 * raw, 1) + " %";
    case Unit::kCount:
      return fixed(raw, 2);
  }
  return fixed(raw, 2);
}

std::string fixed(double x, int digits) {
  const std::string written = host::decimals(x, digits);
  return written.find_first_not_of("-0.") == std::string::npos && written.front() == '-' ? written.substr(1) : written;
}

std::string factor_to_string(double part) {
  const double factor = std::exp(part);
  if (factor >= 0.01 && factor < 100.0) return kTimes + fixed(factor, 2);
  const int power = static_cast<int>(std::floor(std::log10(factor)));
  if (power < -4 || power > 5) return kTimes + fixed(factor / std::pow(10.0, power), 1) + "\u00B7" + "10" + superscript(power);
  const double unit = std::pow(10.0, power - 1);  // two digits are certain
  return kTimes + (power < 0 ? fixed(factor, 1 - power) : grouped(std::lround(std::round(factor / unit) * unit)));
}

}  // namespace earshot::explain
