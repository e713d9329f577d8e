#include "firmware/boards/linux/mission_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "firmware/config/capacities.hpp"

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
  ++result.turns_in.at(static_cast<std::size_t>(result.last.health.state));
}

Clock::Awaited awaited(PortSet& ports, Time next_turn, const MissionTurn& turn) {
  return {
      .ports = ports.readable(), .next_turn = next_turn, .navigation_taken = turn.navigation_taken(), .blocks_heard = ports.blocks_heard()};
}

/// Of the host's time, for turns that are not due because the clock stands still or is scaled.
constexpr std::chrono::seconds kStopPatience{10};

/// When the next turn is due.
class Schedule {
 public:
  Schedule(const Pace& pace, Time began) : pace_(pace), last_(began), next_(began + pace.period) {}

  [[nodiscard]] Time next() const { return next_; }
  /// Something has come that may make a turn. @return whether that is due by now
  [[nodiscard]] bool call(Time now) {
    next_ = std::min(next_, std::max(now, last_ + Duration{config::kLeastBetweenTurns_us}));
    return next_ <= now;
  }
  void put_off(Time now) { next_ = now + pace_.period; }
  /// Missed turns are not made up for.
  void note_turn(Time turn, Time now) {
    last_ = turn;
    next_ = pace_.turns == host::Turns::kOnArrival ? turn + pace_.period : std::max(next_ + pace_.period, now);
  }

 private:
  Pace pace_;
  Time last_;
  Time next_;
};

/// What was asked is answered at once, not a tenth of a second later.
void collect(PortSet& ports, Clock& clock, InputSink& sink) {
  ports.collect(clock, sink);
  ports.serve();
}

/// A loop that was told to stop.
class Stopping {
 public:
  Stopping(LoopResult result, MissionTurn& turn, PortSet& ports, Clock& clock)
      : result_(result), turn_(turn), ports_(ports), clock_(clock) {}

  /// An ABORT if the mission is not over; then turns until its last set-point has been sent often enough.
  /// @param last_turns  turns in which it was sent before
  LoopResult run(Duration period, int last_turns) {
    turn_.note_program_stop();
    const auto deadline = std::chrono::steady_clock::now() + kStopPatience;
    Time next_turn = clock_.now();
    for (bool has_turned = false;;) {
      const Clock::Wake wake = clock_.wait(awaited(ports_, next_turn, turn_));
      ports_.serve();
      const bool is_last_chance = wake == Clock::Wake::kLost || std::chrono::steady_clock::now() >= deadline;
      if (wake == Clock::Wake::kPorts || wake == Clock::Wake::kTurn) collect(ports_, clock_, turn_);
      if (wake == Clock::Wake::kTurn || (is_last_chance && !has_turned)) {
        // Dated with its turn, whenever the signal came: in lock-step that may be before a simulator's tick or while it is read.
        if (!has_turned && !is_over(result_.last.health)) turn_.take(kOwnPort, abort_of(clock_.now()));
        make_turn(turn_, result_);
        has_turned = true;
        next_turn = next_turn + period;
        if (!clock_.answered(result_.last, ports_.setpoints_sent()) || !result_.last.setpoint || ++last_turns >= kLastSetpoints)
          return result_;
      }
      if (is_last_chance) return result_;
    }
  }

 private:
  LoopResult result_;
  MissionTurn& turn_;
  PortSet& ports_;
  Clock& clock_;
};

messages::Ending ending_of(LoopEnd end) {
  switch (end) {
    case LoopEnd::kMissionOver:
      return messages::Ending::kMissionOver;
    case LoopEnd::kStopped:
      return messages::Ending::kStopped;
    case LoopEnd::kClockLost:
    case LoopEnd::kOvertaken:
      return messages::Ending::kClockLost;
  }
  return messages::Ending::kStopped;
}

}  // namespace

messages::ClosingRecord closing_record_of(const LoopResult& result) {
  const messages::Health& health = result.last.health;
  return {.time = result.time,
          .ending = ending_of(result.end),
          .state = health.state,
          .end_reason = health.end_reason,
          .steps_taken = health.steps_taken};
}

LoopResult fly(MissionTurn& turn, PortSet& ports, Clock& clock, const Pace& pace, const std::atomic<bool>& stop, const Hold& hold) {
  LoopResult result;
  result.last = turn.outputs();  // a signal may come before the first turn
  result.began = clock.now();
  Schedule schedule(pace, result.began);
  const std::uint64_t navigation_before = turn.navigation_taken();
  const std::uint64_t snr_before = turn.snr_taken();
  const auto waits_for_sensors = [&] {
    const bool hears = turn.navigation_taken() > navigation_before && turn.snr_taken() > snr_before;
    return result.turns == 0 && !hears && !turn.is_urgent() && clock.now() - result.began < hold.most;
  };
  int last_turns = 0;  // turns since the mission was over, but for those that arrivals made: so close together a bus may lose all of them
  while (!stop) {
    const Clock::Wake wake = clock.wait(awaited(ports, schedule.next(), turn));
    ports.serve();
    if (wake == Clock::Wake::kLost) {
      result.end = LoopEnd::kClockLost;
      return result;
    }
    if (stop) break;
    if (wake == Clock::Wake::kNothing) continue;
    collect(ports, clock, result.turns == 0 && hold.meanwhile != nullptr ? static_cast<InputSink&>(*hold.meanwhile) : turn);
    if (wake == Clock::Wake::kAgain) (void)clock.answered(turn.send_again(), ports.setpoints_sent());
    const bool is_due = wake == Clock::Wake::kTurn;
    const bool is_called = turn.is_called() && pace.turns == host::Turns::kOnArrival;
    if (is_due) ports.tend();
    const bool is_held = waits_for_sensors();
    if (is_held && is_due) {
      schedule.put_off(clock.now());
      if (hold.meanwhile != nullptr && clock.now() >= hold.meanwhile_from) hold.meanwhile->publish_state();
    }
    if (is_held || (!is_due && !(is_called && schedule.call(clock.now())))) continue;
    make_turn(turn, result);
    if (turn.is_overtaken()) {
      result.end = LoopEnd::kOvertaken;
      return result;
    }
    if (!is_due) ports.tend();  // what has come is answered first
    if (!is_called && is_over(result.last.health) && last_turns < kLastSetpoints) ++last_turns;
    schedule.note_turn(result.time, clock.now());
    if (!clock.answered(result.last, ports.setpoints_sent())) {
      result.end = LoopEnd::kMissionOver;
      return result;
    }
  }
  result.found_in = result.last.health.state;
  return Stopping(result, turn, ports, clock).run(pace.period, last_turns);
}

}  // namespace earshot::board
