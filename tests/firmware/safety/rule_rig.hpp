#pragma once

#include <initializer_list>

#include "firmware/config/mission.hpp"
#include "firmware/safety/situation.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::safety {

inline config::Polygon polygon(std::initializer_list<NorthEast> corners) {
  config::Polygon polygon;
  for (const NorthEast corner : corners) static_cast<void>(polygon.push_back(corner));
  return polygon;
}

inline config::Polygon square(double from, double to) {
  return polygon({at(from, from), at(to, from), at(to, to), at(from, to)});
}

/// 10 km x 10 km at 300 m and 2 m/s, with a fence around it; the vehicle turns within 20 m and drifts with 0.5 m/s at the most.
inline config::Mission fenced_mission() {
  config::Mission mission{.operating_area = {.south_west = at(0, 0), .north_east = at(10'000, 10'000)},
                          .edge_margin = Meters{500},
                          .search_depth = Meters{300},
                          .max_depth = Meters{320},
                          .search_speed = MetersPerSecond{2},
                          .step_length = Meters{1000},
                          .max_steps = 100,
                          .max_time = Duration::seconds(60'000),
                          .navigation_timeout = Duration::seconds(5),
                          .snr_timeout = Duration::seconds(30),
                          .detection_threshold = Decibels{10}};
  mission.safety.fence = config::Fence{.inside = square(0, 10'000), .save = square(-100, 10'100), .halt = square(-300, 10'300)};
  mission.safety.safe_point = at(5000, 5000);
  mission.safety.vehicle.max_speed = MetersPerSecond{3};
  mission.safety.vehicle.max_current = MetersPerSecond{0.5};
  mission.safety.vehicle.turn_radius = Meters{20};
  mission.safety.vehicle.battery_percent_per_km = 2.0;
  return mission;
}

inline messages::Navigation fix_at(Time time, NorthEast place, double heading = 0.0, double depth_m = 300.0) {
  return {.time = time, .position = place, .depth = Meters{depth_m}, .heading = Radians{heading}, .speed = MetersPerSecond{2}};
}

/// A search that began at 100 s; now it is 110 s, and all is well: a fix a moment ago, and an SNR.
inline Situation well(const config::Mission& mission, NorthEast place = at(5000, 5000), double heading = 0.0, double depth_m = 300.0) {
  Situation situation;
  situation.now = Time{} + Duration::seconds(110);
  situation.search_began = Time{} + Duration::seconds(100);
  situation.snr = situation.now;
  situation.navigation = NavigationJudge(mission.safety.vehicle, mission.navigation_timeout);
  const messages::Navigation fix = fix_at(situation.now, place, heading, depth_m);
  static_cast<void>(situation.navigation.take(situation.now, fix, true));
  situation.track.begin(fix);
  return situation;
}

}  // namespace earshot::safety
