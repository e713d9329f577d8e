#include "tests/safety/drawn_mission.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "firmware/core/geometry.hpp"
#include "firmware/core/random.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/safety/check.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::campaign {
namespace {

using config::Polygon;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed, 17) {}
  double between(double low, double high) { return low + (high - low) * random_.uniform_double(); }
  bool chance(double share) { return random_.uniform_double() < share; }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(random_.uniform_double() * static_cast<double>(count)); }

 private:
  Pcg32 random_;
};

Polygon around(const Rectangle& area, double margin_m) {
  const Rectangle r = area.moved_in(Meters{-margin_m});
  Polygon polygon;
  for (const NorthEast corner :
       {r.south_west, NorthEast{r.north_east.north, r.south_west.east}, r.north_east, NorthEast{r.south_west.north, r.north_east.east}})
    static_cast<void>(polygon.push_back(corner));
  return polygon;
}

/// A circle of sixteen corners that has the rectangle within it, and `margin_m` besides.
Polygon circle_around(const Rectangle& area, double margin_m) {
  const NorthEast size = area.north_east - area.south_west;
  const NorthEast middle = area.south_west + at(size.north.value / 2, size.east.value / 2);
  const double step = 2 * std::numbers::pi / config::kMaxPolygonCorners;
  const double radius = (std::hypot(size.north.value, size.east.value) / 2 + margin_m) / std::cos(step / 2);
  Polygon polygon;
  for (std::size_t i = 0; i < config::kMaxPolygonCorners; ++i) {
    const double angle = step * static_cast<double>(i);
    static_cast<void>(polygon.push_back(middle + at(radius * std::cos(angle), radius * std::sin(angle))));
  }
  return polygon;
}

/// A star of sixteen corners with the rectangle within it, some further out than others.
Polygon star_around(const Rectangle& area, double margin_m, std::span<const double> reach) {
  Polygon circle = circle_around(area, margin_m);
  const NorthEast size = area.north_east - area.south_west;
  const NorthEast middle = area.south_west + at(size.north.value / 2, size.east.value / 2);
  Polygon star;
  for (std::size_t i = 0; i < circle.size(); ++i) {
    const NorthEast out = circle[i] - middle;
    const double longer = 1.0 + reach[i] / length_of(out).value;
    static_cast<void>(star.push_back(middle + NorthEast{.north = out.north * longer, .east = out.east * longer}));
  }
  return star;
}

/// The tiers lie nearer to each other at a star's bays than at its corners: the halt polygon is moved out until the mission is accepted.
config::Fence star_fence_of(config::Mission mission, double inside_m, double save_m, Draw& draw) {
  std::array<double, config::kMaxPolygonCorners> reach{};
  for (double& r : reach) r = draw.between(0.0, 0.3) * mission.step_length.value;
  config::Fence fence{.inside = star_around(mission.operating_area, inside_m, reach),
                      .save = star_around(mission.operating_area, save_m, reach),
                      .halt = {}};
  for (double halt_m = save_m;; halt_m += 0.5 * safety::margin_to_halt(mission).value) {
    fence.halt = star_around(mission.operating_area, halt_m, reach);
    mission.safety.fence = fence;
    if (safety::check(mission).is_none()) return fence;
  }
}

config::Fence fence_of(const config::Mission& mission, Draw& draw) {
  const auto tier = draw.chance(0.5) ? around : circle_around;
  const double inside = draw.between(0.0, 50.0) - std::min(mission.edge_margin.value, 0.0);
  const double save = inside + draw.between(0.0, 100.0);
  // A circle's margin is that of its corners; its edges are as far, up to rounding.
  const double halt = save + safety::margin_to_halt(mission).value + draw.between(0.1, 50.0);
  if (draw.chance(0.3)) return star_fence_of(mission, inside, save, draw);
  return {.inside = tier(mission.operating_area, inside),
          .save = tier(mission.operating_area, save),
          .halt = tier(mission.operating_area, halt)};
}

config::VehicleLimits limits_of(double search_speed_mps, Draw& draw) {
  config::VehicleLimits limits;
  limits.max_speed = MetersPerSecond{search_speed_mps * draw.between(1.0, 1.5)};
  limits.max_current = MetersPerSecond{search_speed_mps * (draw.chance(0.3) ? 0.0 : draw.between(0.0, 0.5))};
  limits.turn_radius = Meters{draw.chance(0.3) ? 0.0 : draw.between(1.0, 80.0)};
  limits.hold_speed = MetersPerSecond{draw.chance(0.5) ? 0.0 : 0.5 * search_speed_mps};
  limits.ascent_speed = MetersPerSecond{draw.chance(0.5) ? 0.0 : draw.between(0.5, 1.0) * search_speed_mps};
  return limits;
}

/// What sees where it is in its area, and goes to one of four compass points by weights of some kind.
std::unique_ptr<policy::FrozenPolicy> policy_of(const config::Mission& mission, std::string_view& kind, Draw& draw) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->area_size = mission.operating_area.north_east - mission.operating_area.south_west;
  policy->observation.spec = policy::simple_state(policy->area_size);
  for (const UnitNorthEast& direction : {UnitNorthEast{1, 0}, UnitNorthEast{0, 1}, UnitNorthEast{-1, 0}, UnitNorthEast{0, -1}})
    static_cast<void>(policy->actions.push_back(direction));
  policy->step_length = mission.step_length;
  policy->detection_threshold = mission.detection_threshold;
  policy->network.observation_size = 2;
  policy->network.hidden_sizes = {64, 64};
  policy->network.action_count = 4;
  policy->draw = policy::ActionDraw::kArgmax;
  constexpr std::array<std::string_view, 3> kKinds{"random", "edge-seeking", "stuck"};
  kind = kKinds[draw.index(kKinds.size())];
  policy->network.layer(2).bias[0] = kWatermark;
  if (kind == "random") {
    policy->draw = policy::ActionDraw::kSampled;
    const auto weight = [&draw] { return static_cast<float>(draw.between(-0.5, 0.5)); };
    for (float& w : policy->network.layer(0).packed) w = weight();
    for (float& w : policy->network.layer(1).packed) w = weight();
    for (float& w : policy->network.layer(2).packed) w = weight();
  } else if (kind == "edge-seeking") {
    policy->network.layer(2).bias[1 + draw.index(3)] = 5.0F;  // one way, and along the edge when it is there
    policy->draw = policy::ActionDraw::kSampled;
  } else {
    policy->network.layer(2).bias[1 + draw.index(3)] = 50.0F;
  }
  policy::record_golden(*policy, *std::make_unique<policy::SearchMemory>(), *std::make_unique<policy::OceanTables>());
  return policy;
}

}  // namespace

std::string_view to_string(Fault fault) {
  constexpr std::array<std::string_view, kFaults> kWords{"none",          "stray fix",   "fixes dated ahead",
                                                         "late fixes",    "poor fix",    "old order",
                                                         "short silence", "pause",       "listens first",
                                                         "tightened",     "low battery", "outward way-points",
                                                         "no fix",        "frozen fix",  "second sender",
                                                         "no SNR",        "abort order", "policy is no number",
                                                         "leak",          "stuck",       "sinks",
                                                         "carried away"};
  return kWords[static_cast<std::size_t>(fault)];
}

DrawnMission draw(std::uint64_t seed) {
  Draw draw(seed);
  DrawnMission drawn;
  config::Mission& mission = drawn.mission;
  const double step_m = draw.between(200.0, 1500.0);
  const double margin_m = draw.between(0.0, draw.chance(0.3) ? 1.0 : 300.0);
  const auto side_m = [&] { return 2 * margin_m + step_m * draw.between(2.01, 12.0); };
  const NorthEast corner = at(draw.between(-20'000, 20'000), draw.between(-20'000, 20'000));
  const double height_m = side_m();
  mission.operating_area = {.south_west = corner, .north_east = corner + at(height_m, side_m())};
  mission.edge_margin = Meters{margin_m};
  mission.search_depth = Meters{draw.between(5.0, 500.0)};
  mission.max_depth = mission.search_depth + Meters{draw.between(5.0, 100.0)};
  mission.search_speed = MetersPerSecond{draw.between(0.5, 2.5)};
  mission.step_length = Meters{step_m};
  mission.max_steps = static_cast<std::uint32_t>(1 + draw.index(50));
  mission.max_time = Duration::seconds(10'000'000);
  mission.navigation_timeout = Duration::seconds(static_cast<std::int64_t>(draw.between(3.0, 12.0)));
  mission.snr_timeout = Duration::seconds(static_cast<std::int64_t>(draw.between(5.0, 60.0)));
  mission.detection_threshold = Decibels{10};
  mission.action_seed = seed;
  mission.safety.vehicle = limits_of(mission.search_speed.value, draw);
  mission.safety.fence = fence_of(mission, draw);
  static_cast<void>(mission.safety.rules.push_back({.condition = config::Condition::kLeak,
                                                    .limit = 0.0,
                                                    .persistence = Duration::seconds(static_cast<std::int64_t>(draw.between(0.0, 10.0))),
                                                    .response = config::Response::kRelease,
                                                    .is_latched = true}));
  const NorthEast size = mission.operating_area.north_east - mission.operating_area.south_west;
  mission.safety.safe_point =
      mission.operating_area.south_west + at(size.north.value * draw.between(0.1, 0.9), size.east.value * draw.between(0.1, 0.9));
  mission.safety.vehicle.battery_percent_per_km = draw.between(0.0, 0.5);
  drawn.battery_at_home_percent = draw.between(10.0, 30.0);
  static_cast<void>(mission.safety.rules.push_back({.condition = config::Condition::kBatteryAtHome,
                                                    .limit = drawn.battery_at_home_percent,
                                                    .persistence = Duration::seconds(static_cast<std::int64_t>(draw.between(0.0, 30.0))),
                                                    .response = config::Response::kReturn,
                                                    .is_latched = true}));
  drawn.policy = policy_of(mission, drawn.policy_kind, draw);
  drawn.start = mission.operating_area.south_west + at(height_m * draw.between(0.05, 0.95), 0.0);
  drawn.start.east = mission.operating_area.south_west.east +
                     (mission.operating_area.north_east.east - mission.operating_area.south_west.east) * draw.between(0.05, 0.95);
  const double current_mps = mission.safety.vehicle.max_current.value * draw.between(0.0, 1.0);
  const double towards = draw.between(0.0, 2 * std::numbers::pi);
  drawn.vehicle = {.top_speed_mps = mission.safety.vehicle.max_speed.value,
                   .turn_radius_m = mission.safety.vehicle.turn_radius.value * draw.between(0.3, 1.0),
                   .current_north_mps = current_mps * std::cos(towards),
                   .current_east_mps = current_mps * std::sin(towards),
                   .climb_mps = draw.between(0.1, 0.8)};
  drawn.fault = draw.chance(0.25) ? Fault::kNone : static_cast<Fault>(1 + draw.index(kFaults - 1));
  const double leg_s = step_m / mission.search_speed.value;
  drawn.fault_after = Duration::seconds(static_cast<std::int64_t>(draw.between(1.0, 0.8 * leg_s * mission.max_steps)));
  return drawn;
}

}  // namespace earshot::campaign
