#include "tests/safety/flipped_flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "firmware/core/random.hpp"
#include "firmware/policy/observation.hpp"
#include "firmware/safety/fence.hpp"

namespace earshot::campaign {
namespace {

using messages::MissionState;

constexpr Duration kSecond = Duration::seconds(1);
constexpr int kTurnsAfter = 60;

/// The first members of a Runtime and of its SearchAgent as they are laid out: what follows the search's memory is state again.
struct Agent {
  policy::FrozenPolicy policy;
  policy::OceanTables tables;
  policy::SearchMemory memory;
};
struct FirstMembers {
  config::Mission mission;
  Agent agent;
};
constexpr std::size_t kPolicy = offsetof(FirstMembers, agent) + offsetof(Agent, policy);
constexpr std::size_t kTables = offsetof(FirstMembers, agent) + offsetof(Agent, tables);
constexpr std::size_t kMemory = offsetof(FirstMembers, agent) + offsetof(Agent, memory);
constexpr std::size_t kState = sizeof(FirstMembers);
static_assert(kState < sizeof(runtime::Runtime));

}  // namespace

FlippedFlight::FlippedFlight(std::uint64_t seed) : drawn_(draw(seed)) {
  const double leg_s = drawn_.mission.step_length.value / drawn_.mission.search_speed.value;
  const double longest_s = std::min(0.8 * leg_s * drawn_.mission.max_steps, 4000.0);
  // One that the current carries along may be over sooner.
  for (auto turns = static_cast<int>(Pcg32(seed, 29).uniform_double() * longest_s) + 1; !flies_to_moment(turns); turns /= 2) {
  }
  flown_ = std::make_unique<Moment>(*begin_);
}

bool FlippedFlight::flies_to_moment(int turns) {
  begin_ = std::make_unique<Moment>(Moment{.runtime = {},
                                           .vehicle = {drawn_.start, drawn_.vehicle, drawn_.mission.safety.vehicle.ascent_speed.value},
                                           .now = Time{1'000'000'000},
                                           .outputs = {}});
  if (begin_->runtime.configure(drawn_.mission, *drawn_.policy, *std::make_unique<policy::OceanTables>()) != Status::kOk)
    throw std::logic_error("the mission is refused");
  turn(*begin_);
  begin_->runtime.take(
      {.arrival = begin_->now,
       .port = 0,
       .sequence = 0,
       .value = messages::OperatorCommand{
           .time = begin_->now, .expiry = begin_->now + kSecond, .issuer = 1, .number = 1, .order = messages::Order::kStart}});
  for (int i = 0; i <= turns; ++i) turn(*begin_);
  return begin_->outputs.health.state == MissionState::kSearch;
}

void FlippedFlight::turn(Moment& moment) const {
  moment.now = moment.now + kSecond;
  moment.vehicle.pass_second();
  const auto take = [&moment](const auto& value) {
    moment.runtime.take({.arrival = moment.now, .port = 0, .sequence = moment.sequence++, .value = value});
  };
  take(moment.vehicle.fix(moment.now));
  take(messages::SnrMeasurement{.time = moment.now, .snr = Decibels{-5.0}});
  take(messages::VehicleStatus{.time = moment.now, .altitude = Meters{100.0}, .battery_percent = 90.0});
  moment.outputs = moment.runtime.step(moment.now);
  if (moment.outputs.setpoint) moment.vehicle.obey(*moment.outputs.setpoint);
}

std::uint64_t FlippedFlight::drawn_bit(Part part, double share) const {
  constexpr std::size_t kAll = sizeof(runtime::Runtime);
  constexpr std::size_t kDecisiveBytes = kPolicy + (kAll - kState);
  const auto byte = static_cast<std::size_t>(share * static_cast<double>(part == Part::kDecisive ? kDecisiveBytes : kAll));
  const std::size_t place = part == Part::kDecisive && byte >= kPolicy ? byte - kPolicy + kState : byte;
  const auto bit = static_cast<std::uint64_t>(share * 1e9) % 8;
  return 8 * place + bit;
}

std::string_view FlippedFlight::name_of(std::uint64_t bit) const {
  const std::size_t place = bit / 8;
  if (place < kPolicy) return "mission and limits";
  if (place < kTables) return "policy";
  if (place < kMemory) return "ocean tables";
  return place < kState ? "what the search remembers" : "state, latches, timers, their twins";
}

FlipResult FlippedFlight::fly_with(std::uint64_t bit) {
  Moment& moment = *flown_;
  moment = *begin_;
  auto* const bytes = reinterpret_cast<unsigned char*>(&moment.runtime);
  bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1U << (bit % 8)));
  FlipResult result;
  for (int i = 0; i < kTurnsAfter && result.broken.empty(); ++i) {
    turn(moment);
    result.broken = broken_in(moment);
    result.is_noticed = result.is_noticed || moment.outputs.health.end_reason == messages::EndReason::kMemoryFault;
  }
  return result;
}

std::string FlippedFlight::broken_in(const Moment& moment) const {
  const config::Mission& mission = drawn_.mission;
  if (!moment.outputs.setpoint) return "no set-point in a search, or after it";
  const messages::Setpoint& s = *moment.outputs.setpoint;
  const double most_mps = std::max(mission.search_speed, mission.safety.vehicle.ascent_speed).value;
  const bool is_within = std::abs(s.heading.value) <= std::numbers::pi && s.speed.value >= 0.0 && s.speed.value <= most_mps &&
                         s.depth.value >= 0.0 && s.depth.value <= mission.max_depth.value && is_finite(s.waypoint);
  if (!is_within) return "a set-point outside its limits";
  if (moment.vehicle.depth_m() > mission.max_depth.value) return "the vehicle is below its depth limit";
  if (moment.outputs.health.state >= MissionState::kDone) return {};  // it drifts where it came up
  return safety::beyond(mission.safety.fence->halt, moment.vehicle.position()).value > 0.0 ? "the vehicle is beyond the halt polygon" : "";
}

}  // namespace earshot::campaign
