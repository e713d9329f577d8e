#pragma once

#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/messages/decision.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::replay_view {

inline constexpr Time kBegan{1'795'000'000'000'000};

/// Taken so many seconds after the beginning at 12 km north, 12 km east, where 15.5 dB are heard.
inline messages::Decision decision_to(std::uint32_t step, double seconds, double north_m, double east_m) {
  messages::Decision d;
  d.time = kBegan + Duration{static_cast<std::int64_t>(seconds * 1e6)};
  d.step = step;
  d.position = at(12'000, 12'000);
  d.snr = Decibels{15.5};
  d.detected = true;
  d.waypoint = at(north_m, east_m);
  return d;
}

}  // namespace earshot::replay_view
