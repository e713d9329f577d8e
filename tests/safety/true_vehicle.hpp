#pragma once

#include <algorithm>
#include <cmath>

#include "firmware/core/math.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/setpoint.hpp"
#include "tests/safety/drawn_mission.hpp"

namespace earshot::campaign {

/// Where the vehicle truly is. It obeys its set-points as its performance allows, at once in speed; told to a shallower depth it stays as
/// deep as it is until it has turned up.
class TrueVehicle {
 public:
  TrueVehicle(NorthEast start, const Vehicle& vehicle, double needs_speed_to_climb_mps, double turns_up_s = 0.0)
      : position_(start), vehicle_(vehicle), needs_speed_to_climb_mps_(needs_speed_to_climb_mps), turns_up_s_(turns_up_s) {}

  void obey(const messages::Setpoint& setpoint) {
    if (setpoint.depth < setpoint_.depth) left_to_turn_s_ = turns_up_s_;
    setpoint_ = setpoint;
  }
  void pass_second() {
    for (int i = 0; i < kPieces; ++i) pass(1.0 / kPieces);
  }

  // What breaks it.
  void anchor() { is_anchored_ = true; }
  void sink() { sinks_ = true; }
  void be_carried(double north_mps, double east_mps) {
    vehicle_.current_north_mps = north_mps;
    vehicle_.current_east_mps = east_mps;
  }

  [[nodiscard]] NorthEast position() const { return position_; }
  [[nodiscard]] double depth_m() const { return depth_m_; }
  [[nodiscard]] messages::Navigation fix(Time now) const {
    return {.time = now,
            .position = position_,
            .depth = Meters{depth_m_},
            .heading = wrap_to_pi(Radians{heading_rad_}),
            .speed = MetersPerSecond{speed_mps_}};
  }

 private:
  static constexpr int kPieces = 4;

  void pass(double s) {
    speed_mps_ = is_anchored_ ? 0.0 : std::min(setpoint_.speed.value, vehicle_.top_speed_mps);
    const double error = wrap_to_pi(Radians{setpoint_.heading.value - heading_rad_}).value;
    const double most = vehicle_.turn_radius_m > 0.0 ? speed_mps_ / vehicle_.turn_radius_m * s : 10.0;
    heading_rad_ += std::clamp(error, -most, most);
    if (!is_anchored_) {
      position_.north = position_.north + Meters{(speed_mps_ * std::cos(heading_rad_) + vehicle_.current_north_mps) * s};
      position_.east = position_.east + Meters{(speed_mps_ * std::sin(heading_rad_) + vehicle_.current_east_mps) * s};
    }
    const double wanted_m = setpoint_.depth.value - depth_m_;
    const bool can_climb = (speed_mps_ >= needs_speed_to_climb_mps_ && !(left_to_turn_s_ > 0.0)) || wanted_m > 0.0;
    if (speed_mps_ >= needs_speed_to_climb_mps_) left_to_turn_s_ -= s;
    if (sinks_) {
      depth_m_ += 1.0 * s;
    } else if (can_climb) {
      depth_m_ += std::clamp(wanted_m, -vehicle_.climb_mps * s, vehicle_.climb_mps * s);
    }
  }

  NorthEast position_;
  Vehicle vehicle_;
  double needs_speed_to_climb_mps_;
  double turns_up_s_;
  double left_to_turn_s_ = 0.0;
  messages::Setpoint setpoint_;
  double heading_rad_ = 0.0;
  double speed_mps_ = 0.0;
  double depth_m_ = 0.0;
  bool is_anchored_ = false;
  bool sinks_ = false;
};

}  // namespace earshot::campaign
