#pragma once

#include <cstdint>
#include <memory>

#include "firmware/config/mission.hpp"
#include "firmware/core/math.hpp"
#include "firmware/messages/input.hpp"
#include "firmware/runtime/runtime.hpp"
#include "tests/fuzz/targets/fuzz_target.hpp"
#include "tests/support/mission_for.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::fuzz {

/// A runtime with a random walk, and what must never come of its inputs.
class FlownRuntime {
 public:
  FlownRuntime() : runtime_(std::make_unique<runtime::Runtime>(configured())) {}

  /// @param later  since the last
  void take(decltype(messages::Input::value) value, Duration later) {
    now_ = now_ + later;
    const WithoutHeap without;
    runtime_->take({.arrival = now_, .port = 0, .sequence = sequence_++, .value = value});
  }

  /// One turn. @return what it said
  runtime::Outputs step() {
    runtime::Outputs outputs;
    {
      const WithoutHeap without;
      outputs = runtime_->step(now_);
    }
    if (outputs.setpoint) require_sound(*outputs.setpoint);
    if (outputs.decision) require(mission_.operating_area.contains(outputs.decision->waypoint), "a way-point lies outside the area");
    require(outputs.health.state <= messages::MissionState::kAbort, "a state that there is not");
    return outputs;
  }

  [[nodiscard]] Time now() const { return now_; }

 private:
  static config::Mission mission() { return support::mission_for(support::random_walk_policy()); }

  /// Made once: its policy's golden trajectories take longer than an input.
  static const runtime::Runtime& configured() {
    static const std::unique_ptr<const runtime::Runtime> runtime = [] {
      auto made = std::make_unique<runtime::Runtime>();
      const auto no_tables = std::make_unique<policy::OceanTables>();
      require(made->configure(mission(), support::random_walk_policy(), *no_tables) == Status::kOk,
              "the runtime does not take its mission");
      return made;
    }();
    return *runtime;
  }

  void require_sound(const messages::Setpoint& setpoint) const {
    require(is_finite(setpoint.waypoint) && is_finite(setpoint.heading.value), "a set-point is not finite");
    require(setpoint.speed.value >= 0.0 && setpoint.speed <= mission_.search_speed, "a set-point's speed is out of its limits");
    require(setpoint.depth.value >= 0.0 && setpoint.depth <= mission_.max_depth, "a set-point's depth is out of its limits");
  }

  std::unique_ptr<runtime::Runtime> runtime_;
  config::Mission mission_ = mission();
  Time now_{1'000'000};
  std::uint64_t sequence_ = 0;
};

}  // namespace earshot::fuzz
