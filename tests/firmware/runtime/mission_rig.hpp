#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/firmware/place.hpp"
#include "tests/firmware/policy/format/unsigned_file.hpp"
#include "tests/support/layer_weights.hpp"
#include "tests/support/three_oceans.hpp"

namespace earshot::runtime {

using messages::EndReason;
using messages::MissionState;
using messages::Order;

inline constexpr std::size_t kNorthward = 0;
inline constexpr std::size_t kEastward = 1;
inline constexpr std::size_t kSouthward = 2;
inline constexpr std::size_t kWestward = 3;

inline constexpr int kLeg_s = 500;  ///< 1 km at 2 m/s

/// The paper's mission, in an area whose corner is not the origin.
inline config::Mission paper_mission() {
  return {.operating_area = {.south_west = at(-5000, 1000), .north_east = at(20000, 26000)},
          .edge_margin = Meters{500},
          .search_depth = Meters{300},
          .max_depth = Meters{320},
          .search_speed = MetersPerSecond{2},
          .step_length = Meters{1000},
          .max_steps = 100,
          .max_time = Duration::seconds(60000),
          .navigation_timeout = Duration::seconds(5),
          .snr_timeout = Duration::seconds(30),
          .detection_threshold = Decibels{10},
          .action_seed = 1};
}

/// Simple state, four compass points; weights all zero, so that the output biases alone decide.
inline std::unique_ptr<policy::FrozenPolicy> policy_that_goes(std::size_t action) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy->observation.spec = policy::simple_state(at(25000, 25000));
  for (const UnitNorthEast& direction : {UnitNorthEast{1, 0}, UnitNorthEast{0, 1}, UnitNorthEast{-1, 0}, UnitNorthEast{0, -1}}) {
    static_cast<void>(policy->actions.push_back(direction));
  }
  policy->step_length = Meters{1000};
  policy->area_size = at(25000, 25000);
  policy->detection_threshold = Decibels{10};
  policy->draw = policy::ActionDraw::kArgmax;
  policy->network.observation_size = 2;
  policy->network.hidden_sizes = {64, 64};
  policy->network.action_count = 4;
  policy->network.layer(2).bias[action] = 1.0F;
  return policy;
}

/// Memory state of two steps, random weights, actions drawn from the softmax: a policy that wanders.
inline std::unique_ptr<policy::FrozenPolicy> policy_that_wanders() {
  auto policy = policy_that_goes(kNorthward);
  policy->observation.spec = policy::memory_state(2, Meters{1000}, Decibels{10}).value();
  policy->draw = policy::ActionDraw::kSampled;
  tests::set_inputs(policy->network, 6);
  Pcg32 random(77);
  for (float& weight : policy->network.layer(0).packed) weight = random.uniform_float() - 0.5F;
  for (float& weight : policy->network.layer(1).packed) weight = random.uniform_float() - 0.5F;
  for (float& weight : policy->network.layer(2).packed) weight = random.uniform_float() - 0.5F;
  return policy;
}

/// policy_that_goes(kNorthward) that sees a belief.
inline std::unique_ptr<policy::FrozenPolicy> policy_that_believes() {
  auto policy = policy_that_goes(kNorthward);
  policy::BeliefModel& belief = policy->observation.belief;
  belief.area_size = policy->area_size;
  belief.actions = policy->actions;
  belief.cells_north = belief.cells_east = 25;  // a quarter of what it has else, for machines that are emulated
  policy->observation.spec = policy::belief_state(belief);
  tests::set_inputs(policy->network, policy->observation.spec.size());
  return policy;
}

/// A policy that goes by its belief's own advice: the same, but for its network.
inline std::unique_ptr<policy::FrozenPolicy> policy_that_advises() {
  auto policy = policy_that_believes();
  policy->network = {};
  policy->network.observation_size = policy->observation.spec.size();
  policy->network.action_count = policy->actions.size();
  return policy;
}

/// Of the paper's area, depth and frequency.
inline std::unique_ptr<policy::OceanTables> paper_oceans() {
  return support::three_oceans(at(25000, 25000));
}

/// Of these the first alone: 50 dB at the source, and 1 dB less every 393.7 m, 1/127 of 50 km.
inline std::unique_ptr<policy::OceanTables> one_ocean() {
  auto tables = paper_oceans();
  const policy::OceanTable near = tables->tables[0];
  tables->tables.clear();
  static_cast<void>(tables->tables.push_back(near));
  return tables;
}

/// The policy with what this build makes of its golden trajectories, as a freezer would leave it; one that cannot fly stays as it is.
/// A belief's are flown once a policy: on an emulated machine they take longer than the test.
inline std::unique_ptr<policy::FrozenPolicy> frozen(const policy::FrozenPolicy& policy) {
  auto copy = std::make_unique<policy::FrozenPolicy>(policy);
  if (!policy::check(policy).is_none()) return copy;
  static std::map<std::string, policy::GoldenTrajectories> flown;  // by its file
  const bool sees_belief = policy::needs_belief(policy.observation.spec);
  const std::vector<std::uint8_t> file = sees_belief ? policy::unsigned_file(policy) : std::vector<std::uint8_t>{};
  const std::string name(file.begin(), file.end());
  if (const auto known = flown.find(name); known != flown.end()) {
    copy->golden = known->second;
    return copy;
  }
  policy::record_golden(*copy, *std::make_unique<policy::SearchMemory>(), *std::make_unique<policy::OceanTables>());
  if (sees_belief) flown.emplace(name, copy->golden);
  return copy;
}

/// The first command of a ground station: good for as long as anybody may want it.
inline messages::OperatorCommand command_of(Order order, Time time, std::uint32_t number = 1) {
  return {.time = time, .expiry = time + Duration::seconds(3600), .issuer = 1, .number = number, .order = order};
}

/// What arrives in one turn, where it is at most one of each kind.
struct Arriving {
  std::optional<messages::Navigation> navigation = std::nullopt;
  std::optional<messages::SnrMeasurement> snr = std::nullopt;
  std::optional<Order> order = std::nullopt;
};

/// A runtime and a vehicle that does at once what it is told: 1 Hz navigation and SNR, no current, no turning circle.
struct Rig {
  explicit Rig(const policy::FrozenPolicy& policy, const config::Mission& mission = paper_mission())
      : Rig(policy, mission, *paper_oceans()) {}
  Rig(const policy::FrozenPolicy& policy, const config::Mission& mission, const policy::OceanTables& tables) {
    configured = runtime->configure(mission, *frozen(policy), tables);
  }

  /// One second passes; `arriving` is what arrives at its end.
  const Outputs& step(const Arriving& arriving) {
    now = now + Duration::seconds(1);
    return step_again(arriving);
  }

  /// Another turn at the same moment.
  const Outputs& step_again(const Arriving& arriving) {
    if (arriving.navigation) take(*arriving.navigation);
    if (arriving.snr) take(*arriving.snr);
    if (arriving.order) give(*arriving.order);
    outputs = runtime->step(now);
    if (outputs.setpoint) setpoint = *outputs.setpoint;
    return outputs;
  }

  template <class Value>
  void take(const Value& value) {
    runtime->take({.arrival = now, .port = 1, .sequence = sequence++, .value = value});
  }

  /// A new command of the one ground station.
  void give(Order order) { take(command_of(order, now, ++commands)); }

  [[nodiscard]] MissionState state() const { return outputs.health.state; }
  [[nodiscard]] EndReason end_reason() const { return outputs.health.end_reason; }
  [[nodiscard]] const messages::Counters& counters() const { return outputs.health.counters; }

  /// The vehicle goes as far as it is told to go in one second.
  void move() {
    heading = setpoint.heading;
    const double distance = setpoint.speed.value;
    position = position + at(distance * std::cos(heading.value), distance * std::sin(heading.value));
    depth = setpoint.depth;
  }

  /// One second passes with navigation and SNR as they should be.
  const Outputs& sail(std::optional<Order> order = std::nullopt) {
    move();
    const Time measured = now + Duration::seconds(1);
    return step({.navigation = navigation_at(measured), .snr = messages::SnrMeasurement{.time = measured, .snr = snr}, .order = order});
  }

  /// Sails until the next decision; fails by its caller's expectations when the search ends before.
  const Outputs& sail_to_decision() {
    do {
      sail();
    } while (state() == MissionState::kSearch && !outputs.decision);
    return outputs;
  }

  [[nodiscard]] messages::Navigation navigation_at(Time time) const {
    return {.time = time, .position = position, .depth = depth, .heading = heading, .speed = setpoint.speed};
  }

  std::unique_ptr<Runtime> runtime = std::make_unique<Runtime>();
  Status configured = Status::kNotReady;
  Time now{1'000'000'000};
  NorthEast position = at(7000, 12000);
  Meters depth{0};
  Radians heading{0.25};
  Decibels snr{12};
  Outputs outputs;
  messages::Setpoint setpoint;  ///< the last that was sent; before the first: stop at the surface
  std::uint64_t sequence = 0;
  std::uint32_t commands = 0;
};

/// A search that commands its vehicle, ten seconds old.
inline Rig under_way(const config::Mission& mission = paper_mission(), const policy::FrozenPolicy& policy = *policy_that_goes(kNorthward)) {
  Rig rig(policy, mission);
  EXPECT_EQ(rig.configured, Status::kOk);
  rig.sail(Order::kStart);
  for (int i = 0; i < 10; ++i) rig.sail();
  EXPECT_EQ(rig.state(), MissionState::kSearch);
  return rig;
}

}  // namespace earshot::runtime
