#pragma once

#include "earshot/decision_t.hpp"
#include "firmware/core/time.hpp"

namespace earshot::replay_view {

inline constexpr Time kBegan{1'795'000'000'000'000};

/// Taken so many seconds after the beginning at 12 km north, 12 km east, where 15.5 dB are heard.
inline decision_t decision_to(std::int32_t step, double seconds, double north_m, double east_m) {
  decision_t d{};
  d.utime = kBegan.us + static_cast<std::int64_t>(seconds * 1e6);
  d.step = step;
  d.north_m = 12'000;
  d.east_m = 12'000;
  d.snr_db = 15.5;
  d.detected = 1;
  d.waypoint_north_m = north_m;
  d.waypoint_east_m = east_m;
  return d;
}

}  // namespace earshot::replay_view
