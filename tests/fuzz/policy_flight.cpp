#include "tests/fuzz/policy_flight.hpp"

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "firmware/core/math.hpp"
#include "firmware/policy/check/policy_check.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "tests/support/layer_weights.hpp"
#include "tests/support/mission_for.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/three_oceans.hpp"

namespace earshot::fuzz {
namespace {

constexpr int kTurns = 24;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

void require_within_limits(const config::Mission& mission, const messages::Setpoint& setpoint) {
  require(is_finite(setpoint.waypoint) && is_finite(setpoint.heading.value), "a set-point is not finite");
  require(setpoint.speed.value >= 0.0 && setpoint.speed <= mission.search_speed, "a set-point's speed is out of its limits");
  require(setpoint.depth.value >= 0.0 && setpoint.depth <= mission.max_depth, "a set-point's depth is out of its limits");
}

void require_sound(const policy::FrozenPolicy& policy, const config::Mission& mission, const messages::Decision& decision) {
  require(decision.action < policy.actions.size(), "an action is none of the policy's");
  require(mission.operating_area.contains(decision.waypoint), "a way-point lies outside the area");
  for (std::size_t i = 0; i < policy.observation.spec.size(); ++i)
    require(is_finite(decision.observation[i]), "an observation is no number");
  for (std::size_t i = 0; i < policy.actions.size(); ++i) require(is_finite(decision.logits[i]), "a logit is no number");
}

/// What may be heard: mostly what oceans do, sometimes all that the runtime lets in.
messages::SnrMeasurement sound(Time now, Pcg32& random) {
  const double span = random.next() % 8 == 0 ? messages::kMostSnr.value : 40.0;
  return {
      .time = now, .snr = Decibels{span * (2.0 * static_cast<double>(random.uniform_float()) - 1.0)}, .too_faint = random.next() % 4 == 0};
}

}  // namespace

std::vector<Bytes> good_policies() {
  policy::FrozenPolicy walk = support::random_walk_policy();
  walk.network.layer(2).bias[3] = 0.5F;
  std::vector<Bytes> good{support::signed_bytes(walk)};
  policy::BeliefModel& belief = walk.observation.belief;
  belief.actions = walk.actions;
  belief.step_length = walk.step_length;
  belief.area_size = walk.area_size;
  belief.detection_threshold = walk.detection_threshold;
  belief.cells_north = 12;
  belief.cells_east = 10;
  walk.observation.spec = policy::belief_state(belief);
  tests::set_inputs(walk.network, walk.observation.spec.size());
  Pcg32 random(5);
  for (float& weight : walk.network.layer(0).packed) weight = random.uniform_float() - 0.5F;
  for (float& weight : walk.network.layer(1).packed) weight = random.uniform_float() - 0.5F;
  for (float& weight : walk.network.layer(2).packed) weight = random.uniform_float() - 0.5F;
  good.push_back(support::signed_bytes(walk));
  walk.draw = policy::ActionDraw::kArgmax;
  good.push_back(support::signed_bytes(walk));
  walk.network = {};
  walk.network.observation_size = walk.observation.spec.size();
  walk.network.action_count = walk.actions.size();
  good.push_back(support::signed_bytes(walk));
  return good;
}

bool flies(const policy::FrozenPolicy& policy, runtime::Runtime& runtime, Pcg32& random) {
  const config::Mission mission = support::mission_for(policy);
  const auto tables = support::three_oceans(policy.area_size, mission.search_depth, mission.source_frequency);
  const Status configured = runtime.configure(mission, policy, *tables);
  if (config::check(mission) != Status::kOk) {
    require(configured == Status::kOutOfRange, "a mission without room to search was taken");
    return false;
  }
  // An area may be so wide, or so narrow, that no tables can be.
  if (policy::needs_belief(policy.observation.spec) && !policy::are_usable(*tables, policy::searched_sound(mission))) {
    require(configured == Status::kOutOfRange, "tables that do not reach across the area were taken");
    return false;
  }
  require(configured == Status::kOk, "the runtime refused what the loader took");
  Time now{1'000'000};
  messages::Navigation navigation;
  navigation.position = {0.5 * policy.area_size.north, 0.25 * policy.area_size.east};
  if (!messages::is_usable(navigation)) return false;  // an area so wide that its middle lies where no fix can be
  std::uint32_t sequence = 0;
  const auto take = [&](const auto& value) { runtime.take({.arrival = now, .port = 0, .sequence = ++sequence, .value = value}); };
  take(messages::OperatorCommand{
      .time = now, .expiry = now + Duration::seconds(60), .issuer = 1, .number = 1, .order = messages::Order::kStart});
  int decisions = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    navigation.time = now;
    take(navigation);
    take(sound(now, random));
    const runtime::Outputs outputs = runtime.step(now);
    require(outputs.setpoint.has_value(), "a search commands nothing");
    require_within_limits(mission, *outputs.setpoint);
    if (outputs.decision) require_sound(policy, mission, *outputs.decision);
    decisions += outputs.decision ? 1 : 0;
    navigation.position = outputs.setpoint->waypoint;
    now = now + Duration::seconds(1);
  }
  require(decisions > 0, "no decision was taken");
  return true;
}

Bytes frozen_anew(const Bytes& bytes) {
  const auto policy = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyComplaint complaint;
  if (policy::parse(bytes, *policy, complaint) != Status::kOk) return bytes;
  return support::signed_bytes(*policy);
}

}  // namespace earshot::fuzz
