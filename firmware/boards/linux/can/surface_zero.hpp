#pragma once

#include <algorithm>

#include "firmware/boards/linux/can/vehicle_input.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// Knows when the pressure at the surface is taken: owns whether that is due, and whether it was done. It is done once, with the START that
/// is obeyed: whoever gives it sees where the vehicle is, and it has not moved by our word yet. Deeper than a pressure at the surface can
/// mean, nothing is zeroed.
class SurfaceZero {
 public:
  /// @param is_wanted  the mission asks for it
  explicit SurfaceZero(bool is_wanted) : is_wanted_(is_wanted) {}

  /// To be called every turn.
  void note_turn(Time now, const runtime::Outputs& outputs, VehicleInput& vehicle) {
    const bool was_standing_by = state_ == messages::MissionState::kStandby;
    state_ = outputs.health.state;
    if (!is_wanted_ || is_done_ || !was_standing_by) return;
    if (std::ranges::any_of(outputs.acknowledgements, is_obeyed_start)) is_due_ = true;
    if (!is_due_ || !vehicle.has_fresh_pressure(now)) return;
    is_done_ = vehicle.zero_at_surface();
    is_due_ = false;
  }

 private:
  [[nodiscard]] static bool is_obeyed_start(const messages::CommandAcknowledgement& acknowledgement) {
    return acknowledgement.order == messages::Order::kStart && messages::was_obeyed(acknowledgement.outcome);
  }

  bool is_wanted_;
  bool is_due_ = false;
  bool is_done_ = false;
  messages::MissionState state_ = messages::MissionState::kStandby;  ///< after the last turn
};

}  // namespace earshot::board
