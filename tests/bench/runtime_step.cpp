// Row runtime.step_ns: one turn of a search between two decisions, with a fence of 48 corners and as many rules as a mission may have;
// "peer": the same with the rules that no mission can switch off.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numbers>

#include "firmware/policy/check/policy_check.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/bench/short_form.hpp"

namespace {

using namespace earshot;
using config::Condition;
using config::Response;

constexpr int kTurns = 100;  // less than between two decisions: the least mean is of turns without one

config::Polygon circle(double radius_m) {
  config::Polygon polygon;
  for (std::size_t i = 0; i < config::kMaxPolygonCorners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / config::kMaxPolygonCorners;
    static_cast<void>(polygon.push_back({Meters{radius_m * std::cos(angle)}, Meters{radius_m * std::sin(angle)}}));
  }
  return polygon;
}

config::Mission mission_with(bool all_rules) {
  config::Mission mission{
      .operating_area = {.south_west = {Meters{-12'500}, Meters{-12'500}}, .north_east = {Meters{12'500}, Meters{12'500}}},
      .edge_margin = Meters{250},
      .search_depth = Meters{300},
      .max_depth = Meters{400},
      .search_speed = MetersPerSecond{2},
      .step_length = Meters{1000},
      .max_steps = 1'000'000,
      .max_time = Duration::seconds(10'000'000),
      .navigation_timeout = Duration::seconds(5),
      .snr_timeout = Duration::seconds(5),
      .detection_threshold = Decibels{10}};
  if (!all_rules) return mission;
  mission.safety.fence = config::Fence{.inside = circle(18'200), .save = circle(18'400), .halt = circle(18'600)};
  mission.safety.safe_point = NorthEast{};
  mission.safety.vehicle = {
      .max_speed = MetersPerSecond{3}, .max_current = MetersPerSecond{0.5}, .turn_radius = Meters{20}, .battery_percent_per_km = 0.1};
  // One that acts and a warning before it, each far from its limit.
  struct Watched {
    Condition condition;
    double limit;
    double warning;
  };
  for (const auto& [condition, limit, warning] :
       {Watched{Condition::kVehicleStatusAge, 20, 10}, Watched{Condition::kAutopilotAge, 20, 10},
        Watched{Condition::kOperatorAge, 1e7, 9e6}, Watched{Condition::kAltitude, 5, 10}, Watched{Condition::kSpeed, 10, 5},
        Watched{Condition::kTurnRate, 90, 60}, Watched{Condition::kDistanceTravelled, 1e8, 9e7}, Watched{Condition::kBattery, 5, 10},
        Watched{Condition::kBatteryAtHome, 5, 10}, Watched{Condition::kHeadingIgnored, 180, 179},
        Watched{Condition::kDepthIgnored, 1000, 900}}) {
    static_cast<void>(
        mission.safety.rules.push_back({.condition = condition, .limit = limit, .persistence = {}, .response = Response::kSurface}));
    static_cast<void>(
        mission.safety.rules.push_back({.condition = condition, .limit = warning, .persistence = {}, .response = Response::kWarn}));
  }
  for (const Condition condition : {Condition::kLeak, Condition::kGroundFault, Condition::kAutopilotDisengaged})
    static_cast<void>(
        mission.safety.rules.push_back({.condition = condition, .limit = 0.0, .persistence = {}, .response = Response::kAbort}));
  return mission;
}

std::unique_ptr<policy::FrozenPolicy> policy_that_goes_north() {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->area_size = {Meters{25'000}, Meters{25'000}};
  policy->observation.spec = policy::simple_state(policy->area_size);
  for (const UnitNorthEast& direction : {UnitNorthEast{1, 0}, UnitNorthEast{-1, 0}})
    static_cast<void>(policy->actions.push_back(direction));
  policy->step_length = Meters{1000};
  policy->detection_threshold = Decibels{10};
  policy->draw = policy::ActionDraw::kArgmax;
  policy->network.observation_size = 2;
  policy->network.hidden_sizes = {64, 64};
  policy->network.action_count = 2;
  policy->network.layer(2).bias[0] = 1.0F;
  policy::record_golden(*policy, *std::make_unique<policy::SearchMemory>(), *std::make_unique<policy::OceanTables>());
  return policy;
}

}  // namespace

int main(int argc, char** argv) {
  const bool all_rules = argc < 2 || std::strcmp(argv[1], "peer") != 0;
  const auto runtime = std::make_unique<runtime::Runtime>();
  const config::Mission mission = mission_with(all_rules);
  if (runtime->configure(mission, *policy_that_goes_north(), *std::make_unique<policy::OceanTables>()) != Status::kOk) return 1;
  Time now{1'000'000'000};
  NorthEast place;
  messages::Setpoint setpoint;
  std::uint64_t sequence = 0;
  const auto take = [&](const auto& value) { runtime->take({.arrival = now, .port = 0, .sequence = sequence++, .value = value}); };
  const int rounds = bench::full_or_short(4000, 40);
  double best_ns = 1e9;
  bool is_searching = false;
  for (int round = 0; round < rounds; ++round) {
    double spent_ns = 0.0;
    for (int i = 0; i < kTurns; ++i) {
      now = now + Duration::seconds(1);
      const double heading_rad = setpoint.heading.value;
      place = place + NorthEast{Meters{setpoint.speed.value * std::cos(heading_rad)}, Meters{setpoint.speed.value * std::sin(heading_rad)}};
      take(
          messages::Navigation{.time = now, .position = place, .depth = Meters{300}, .heading = setpoint.heading, .speed = setpoint.speed});
      take(messages::SnrMeasurement{.time = now, .snr = Decibels{3}});
      take(messages::VehicleStatus{.time = now, .altitude = Meters{100}, .battery_percent = 80});
      take(messages::AutopilotStatus{.time = now, .follows_setpoints = true});
      if (!is_searching && !bench::is_wrong_on_purpose())
        take(messages::OperatorCommand{.time = now, .expiry = now, .issuer = 1, .number = 1, .order = messages::Order::kStart});
      const auto began = std::chrono::steady_clock::now();
      const runtime::Outputs outputs = runtime->step(now);
      spent_ns += std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - began).count();
      is_searching = outputs.health.state == messages::MissionState::kSearch;
      if (!is_searching || outputs.health.response != Response::kWarn) {
        std::fprintf(stderr, "a turn was no search's: state %d\n", static_cast<int>(outputs.health.state));
        return 1;
      }
      setpoint = *outputs.setpoint;
    }
    best_ns = std::min(best_ns, spent_ns / kTurns);
  }
  std::printf("{\"value\": %.1f}\n", best_ns);
}
