#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/port/port.hpp"
#include "sim/link/runtime_end.hpp"

namespace earshot::link {

/// A simulator's clock for the vehicle's loop: a turn is due for every tick, once the navigation that the tick announces has
/// come over the vehicle's ports and the sound that it announces has been heard. Time stands still between ticks. What is not dated
/// with its tick was meant for another flight and keeps no date; only what was heard is dated before it, when the sound ended by the dates
/// of its blocks, which are simulation time. All that was heard is taken in the turn itself, so that it does not depend on how fast the
/// ports are.
class LockStepClock final : public board::Clock {
 public:
  /// @param run  as RuntimeEnd's. Throws LinkError.
  LockStepClock(std::uint32_t domain, RunId run) : domain_(domain), link_(domain, run) {}

  [[nodiscard]] bool has_come(std::chrono::milliseconds most) override { return link_.wait_for_simulator(most); }
  [[nodiscard]] std::string lost() const override { return lost_; }
  [[nodiscard]] std::string remark() const override;

  [[nodiscard]] Time now() override { return tick_.time; }
  [[nodiscard]] Time mission_time_of(Time utc) override { return utc == tick_.time ? utc : Time{-1}; }
  [[nodiscard]] Time arrival_of(Time /*utc*/) override { return tick_.time; }
  [[nodiscard]] Time time_heard(Time utc) override;
  [[nodiscard]] bool takes_sound_now() const override { return is_due_; }
  [[nodiscard]] Wake wait(const Awaited& awaited) override;
  [[nodiscard]] bool answered(const runtime::Outputs& outputs, std::uint64_t setpoints_sent) override;

  void go_on_after(const messages::Health& last) override;

  /// The tick of the turn that is due, once.
  [[nodiscard]] std::optional<Tick> take_due();

 private:
  using steady_clock = std::chrono::steady_clock;

  [[nodiscard]] Wake receive();

  std::uint32_t domain_;
  RuntimeEnd link_;
  const char* lost_ = "";
  Tick tick_;
  bool is_waiting_ = false;  ///< for the navigation and the sound that the tick announces
  bool is_due_ = false;
  std::uint64_t turns_made_ = 0;  ///< by a process before this one; its last tick may be asked for again
  steady_clock::time_point deadline_;
  std::optional<NorthEast> believed_source_;  ///< as of the last decision
};

/// What a tick brings: the modelled SNR, the bearing, the battery's charge, and an order. Nothing of it has been judged.
/// @param port  that it came by
void give_inputs(const Tick& tick, std::uint8_t port, board::InputSink& sink);

/// What the tick brings, as a port: the modelled SNR, the bearing, the battery's charge, and the orders of who runs the simulation.
class LockStepPort final : public board::Port {
 public:
  LockStepPort(std::uint8_t index, LockStepClock& clock) : Port(index, {host::Role::kSnr, host::Role::kOperator}), clock_(clock) {}

  void collect(board::Clock& clock, board::InputSink& sink) override;
  std::uint64_t publish(Time /*now*/, const runtime::Outputs& /*outputs*/) override { return 0; }
  [[nodiscard]] int file_descriptor() const override { return -1; }
  [[nodiscard]] board::PortWords words() const override { return {.label = "simulation link"}; }

 private:
  LockStepClock& clock_;
};

}  // namespace earshot::link
