#include "firmware/boards/linux/mission_loop.hpp"

#include <algorithm>

namespace earshot::board {
namespace {

bool is_over(const messages::Health& health) {
  return health.state == messages::MissionState::kDone || health.state == messages::MissionState::kAbort;
}

/// Nobody may say again what a stop signal said: one command is all there is of this issuer.
messages::OperatorCommand abort_of(Time now) {
  return {.time = now, .expiry = now, .issuer = 0, .number = 1, .order = messages::Order::kAbort};
}

void make_turn(MissionTurn& turn, LoopResult& result) {
  result.last = turn();
  result.time = turn.last();
  ++result.turns;
}

/// The last turn of a loop that was told to stop.
LoopResult stopped(LoopResult result, MissionTurn& turn, Clock& clock) {
  if (!is_over(result.last.health)) turn.take(kOwnPort, abort_of(clock.now()));
  make_turn(turn, result);
  return result;
}

}  // namespace

LoopResult fly(MissionTurn& turn, PortSet& ports, Clock& clock, Duration period, const std::atomic<bool>& stop) {
  LoopResult result;
  result.began = clock.now();
  Time next_turn = result.began + period;
  while (!stop) {
    const Clock::Wake wake = clock.wait({.ports = ports.readable(), .next_turn = next_turn, .navigation_taken = turn.navigation_taken()});
    if (wake == Clock::Wake::kLost) {
      result.end = LoopEnd::kClockLost;
      return result;
    }
    if (stop) break;
    if (wake == Clock::Wake::kNothing) continue;
    ports.collect(clock, turn);
    if (wake != Clock::Wake::kTurn) continue;
    ports.tend();
    make_turn(turn, result);
    next_turn = std::max(next_turn + period, clock.now());
    if (!clock.answered(result.last, ports.setpoints_sent())) {
      result.end = LoopEnd::kMissionOver;
      return result;
    }
  }
  return stopped(result, turn, clock);
}

}  // namespace earshot::board
