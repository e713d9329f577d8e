// Judge, track, supervisor and manoeuvre steer a vehicle that is sent at its fence again and again: how far beyond does it get?

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "firmware/core/polygon.hpp"
#include "firmware/core/random.hpp"
#include "firmware/safety/check.hpp"
#include "firmware/safety/fence.hpp"
#include "firmware/safety/manoeuvre.hpp"
#include "firmware/safety/supervisor.hpp"
#include "tests/firmware/emulated.hpp"
#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

constexpr Duration kPiece = Duration::milliseconds(50);  ///< of the true way
constexpr Time kBegin = Time{} + Duration::seconds(100);
constexpr Duration kFlight = Duration::seconds(600);

/// An inside and a save polygon 20 m around it, by its corner angles.
struct Shape {
  config::Polygon inside;
  config::Polygon save;
};

Shape square_shape() {
  return {.inside = square(-400, 400), .save = square(-420, 420)};
}

/// An isosceles tip at the origin of the save polygon that opens northwards.
Shape tip(double half_angle_rad) {
  const double slope = std::tan(half_angle_rad);
  const double back_m = 20.0 / std::sin(half_angle_rad);
  const double side_m = (1000.0 - 20.0 - back_m) * slope;
  return {.inside = polygon({at(back_m, 0), at(980, side_m), at(980, -side_m)}),
          .save = polygon({at(0, 0), at(1000, 1000 * slope), at(1000, -1000 * slope)})};
}

/// Of a fence whose halt polygon is not looked at: what counts is the distance from the save polygon.
class FenceFlight {
 public:
  explicit FenceFlight(std::uint64_t seed) : random_(seed) {
    mission_ = fenced_mission();
    mission_.search_speed = MetersPerSecond{between(0.8, 3.0)};
    mission_.step_length = Meters{1e6};  // progress is no subject here
    mission_.navigation_timeout = Duration::milliseconds(static_cast<std::int64_t>(between(2000, 6000)));
    config::VehicleLimits& vehicle = mission_.safety.vehicle;
    vehicle.max_speed = mission_.search_speed * 1.05;
    vehicle.max_current = mission_.search_speed * (random_.uniform_double() < 0.3 ? 0.0 : between(0.3, 0.9));
    vehicle.turn_radius = Meters{between(10.0, 60.0)};
    const std::array shapes{square_shape(), tip(std::numbers::pi / 24), tip(std::numbers::pi / 6)};
    const Shape& shape = shapes[static_cast<std::size_t>(seed % shapes.size())];
    mission_.safety.fence = config::Fence{.inside = shape.inside, .save = shape.save, .halt = square(-1e5, 1e5)};
    const double towards_rad = between(0.0, 2.0 * std::numbers::pi);
    current_ = at(vehicle.max_current.value * std::cos(towards_rad), vehicle.max_current.value * std::sin(towards_rad));
    do position_ = some_place();
    while (!contains(shape.inside.span(), position_));
    heading_rad_ = between(-std::numbers::pi, std::numbers::pi);
    commanded_rad_ = heading_rad_;
    situation_.search_began = now_;
    situation_.navigation = NavigationJudge(vehicle, mission_.navigation_timeout);
    supervisor_.configure(mission_);
  }

  /// @return how far beyond the save polygon it got, as a share of margin_to_halt
  double fly() {
    double farthest_m = 0.0;
    while (now_ < kBegin + kFlight) {
      move();
      if (now_ >= next_turn_) turn();
      farthest_m = std::max(farthest_m, beyond(mission_.safety.fence->save, position_).value);
    }
    return farthest_m / margin_to_halt(mission_).value;
  }

 private:
  double between(double low, double high) { return low + (high - low) * random_.uniform_double(); }
  NorthEast some_place() { return at(between(-450, 1000), between(-600, 600)); }

  void move() {
    now_ = now_ + kPiece;
    const double s = kPiece.to_seconds();
    const double speed_mps = mission_.search_speed.value;
    const double most_rad = speed_mps / mission_.safety.vehicle.turn_radius.value * s;
    heading_rad_ += std::clamp(std::remainder(commanded_rad_ - heading_rad_, 2.0 * std::numbers::pi), -most_rad, most_rad);
    position_ = position_ + at((speed_mps * std::cos(heading_rad_) + current_.north.value) * s,
                               (speed_mps * std::sin(heading_rad_) + current_.east.value) * s);
  }

  /// Fixes cease once, just before one would say that it leaves the fence, for as long as they may.
  void turn() {
    next_turn_ = next_turn_ + kTurn;
    if (now_ >= silent_until_) give_fix();
    situation_.now = now_;
    situation_.snr = now_;
    (void)supervisor_.watch(mission_, situation_);
    situation_.is_steered_back = supervisor_.acts_on(config::Condition::kOutsideFence);
    ASSERT_LE(supervisor_.response(), std::optional(config::Response::kSteerBack)) << "no rule ends the search";
    commanded_rad_ = situation_.is_steered_back ? steer_back() : search();
  }

  void give_fix() {
    const messages::Navigation fix{.time = now_,
                                   .position = position_,
                                   .depth = mission_.search_depth,
                                   .heading = wrap_to_pi(Radians{heading_rad_}),
                                   .speed = mission_.search_speed};
    ASSERT_TRUE(situation_.navigation.take(now_, fix, true));
    has_fix_ ? situation_.track.take(fix) : situation_.track.begin(fix);
    has_fix_ = true;
    const bool leaves = beyond(mission_.safety.fence->save, place_after_turning(mission_.safety.vehicle, situation_)) > Meters{0.0};
    if (!leaves || was_silent_) return;
    was_silent_ = true;
    silent_until_ = now_ + (mission_.navigation_timeout - kTurn);
  }

  double steer_back() { return manoeuvre_.setpoint(mission_, situation_, config::Response::kSteerBack).heading.value; }

  /// To some place, inside or not.
  double search() {
    manoeuvre_.end();
    if (!goal_ || range_between(position_, *goal_) < Meters{50.0}) goal_ = some_place();
    const NorthEast way = *goal_ - position_;
    return std::atan2(way.east.value, way.north.value);
  }

  static constexpr Duration kTurn = Duration::milliseconds(500);

  Pcg32 random_;
  config::Mission mission_;
  NorthEast current_;
  NorthEast position_;
  double heading_rad_ = 0.0;
  double commanded_rad_ = 0.0;
  Time now_ = kBegin;
  Time next_turn_ = now_;
  Time silent_until_ = now_;
  bool has_fix_ = false;
  bool was_silent_ = false;
  std::optional<NorthEast> goal_;
  Situation situation_;
  Supervisor supervisor_;
  Manoeuvre manoeuvre_;
};

// One flight in fifty went further when no room was asked for that a fence narrower than the circle takes, the furthest by 40 %.
TEST(FenceFlights, StayWithinTheMarginToHalt) {
  for (int seed = 1; seed <= tests::times(600, 60); ++seed) EXPECT_LE(FenceFlight(static_cast<std::uint64_t>(seed)).fly(), 1.0) << seed;
}

// Before, it turned the long way round, outwards, as it kept its side when its turn was over.
TEST(FenceFlights, StaysWithinTheMarginWhenTheWayBackChangesInACorner) {
  EXPECT_LE(FenceFlight(3954).fly(), 1.0);
}

}  // namespace
}  // namespace earshot::safety
