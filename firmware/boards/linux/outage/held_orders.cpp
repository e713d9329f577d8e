#include "firmware/boards/linux/outage/held_orders.hpp"

#include <cstdint>

namespace earshot::board {
namespace {

using messages::MissionState;
using messages::Order;

bool is_over(MissionState state) {
  return state == MissionState::kDone || state == MissionState::kAbort;
}

/// For the turn that comes at once.
constexpr Duration kExpiry = Duration::seconds(30);

}  // namespace

HeldOrders held_orders(const host::SafetyRecord& record, const runtime::Outputs& last, const config::Mission& mission, Time now) {
  HeldOrders held;
  if (record.is_engaged && !last.setpoint) held.impossible = "the vehicle was commanded, and its journal knows nothing of that";
  const bool is_released = last.setpoint && last.setpoint->release_weight;
  if (record.is_released && !is_released) held.impossible = "the drop weight was released, and its journal knows nothing of that";
  // Numbers that rise from one outage to the next: the record's sequence does.
  auto number = static_cast<std::uint32_t>(record.sequence * 4);
  const auto order = [&](Order what, const messages::OperatorLimits& limits = {}) {
    static_cast<void>(held.orders.push_back(
        {.time = now, .expiry = now + kExpiry, .issuer = 0, .number = ++number, .order = what, .limits = limits, .is_verified = true}));
  };
  if (!is_over(last.health.state) && !keeps_limits_of(record, mission)) {
    messages::OperatorLimits limits;
    if (record.max_depth < mission.max_depth) limits.max_depth = record.max_depth;
    if (record.max_speed < mission.search_speed) limits.max_speed = record.max_speed;
    if (record.max_time < mission.max_time) limits.max_time_s = record.max_time.to_seconds();
    order(Order::kTighten, limits);
  }
  if (is_over(record.state)) {
    if (!is_over(last.health.state)) order(Order::kAbort);
  } else if (record.turn >= last.health.turn && record.is_paused != last.health.is_paused) {
    order(record.is_paused ? Order::kPause : Order::kResume);
  }
  return held;
}

bool keeps_limits_of(const host::SafetyRecord& record, const config::Mission& mission) {
  return mission.max_depth <= record.max_depth && mission.search_speed <= record.max_speed && mission.max_time <= record.max_time;
}

}  // namespace earshot::board
