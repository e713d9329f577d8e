#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/messages/setpoint.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// The autopilot's patience: ten periods of a set-point.
inline constexpr Duration kAutopilotPatience = Duration::seconds(10);

/// What an autopilot makes of set-points, whatever bus they come by. When none has come for kAutopilotPatience it stops the vehicle and
/// lets it come up, until the next.
class Helm {
 public:
  /// @param resting  what the vehicle is told before the first set-point
  explicit Helm(const vehicle::Command& resting) : command_(resting) {}

  /// Nothing is taken while somebody else has the helm, nor what no vehicle does: a heading of more than a turn, a speed outside 0 to 5
  /// m/s, a depth outside 0 to 11 km.
  void take(const messages::Setpoint& setpoint, Time now);
  /// Time passes.
  void step(Time now);
  /// Somebody takes the helm: it goes on as it was told last, and takes no set-point. @param is_engaged  whether he gives it back
  void engage(bool is_engaged) { is_engaged_ = is_engaged; }
  /// A fault: it goes on as it was told last, takes set-points, and does not follow them.
  void obey(bool is_obedient) { is_obedient_ = is_obedient; }

  [[nodiscard]] const vehicle::Command& command() const { return command_; }
  [[nodiscard]] bool is_engaged() const { return is_engaged_; }
  [[nodiscard]] std::uint64_t taken() const { return taken_; }  ///< set-points
  /// Whether it gave up waiting for a set-point, and has had none since.
  [[nodiscard]] bool is_forsaken() const { return is_forsaken_; }
  /// Whether a set-point asked for the drop weight: once gone it is gone.
  [[nodiscard]] bool is_weight_released() const { return is_weight_released_; }

 private:
  vehicle::Command command_;
  std::optional<Time> last_;
  bool is_engaged_ = true;
  bool is_obedient_ = true;
  bool is_forsaken_ = false;
  bool is_weight_released_ = false;
  std::uint64_t taken_ = 0;
};

}  // namespace earshot::hil
