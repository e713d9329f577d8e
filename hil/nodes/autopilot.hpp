#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "firmware/core/time.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "hil/nodes/device.hpp"
#include "hil/nodes/membership.hpp"
#include "hil/nodes/pace.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// The autopilot's patience: ten periods of a set-point.
inline constexpr Duration kAutopilotPatience = Duration::seconds(10);

/// Takes set-points off the bus (65290 and 127237) and says what the vehicle is told. When none has come for kAutopilotPatience it stops
/// the vehicle and lets it come up, until the next. Once a second it says whether it follows them (65294).
class Autopilot final : public Device {
 public:
  /// @param resting  what the vehicle is told before the first set-point
  Autopilot(const vehicle::Command& resting, std::uint32_t unique_number);

  [[nodiscard]] std::string_view name() const override { return membership_.model(); }
  [[nodiscard]] std::optional<std::uint8_t> address() const override { return membership_.address(); }
  void accept(const n2k::Frame& frame, Time now) override;
  void step(Time now, Frames& frames) override;

  [[nodiscard]] const vehicle::Command& command() const { return command_; }
  [[nodiscard]] std::uint64_t taken() const { return taken_; }  ///< set-points
  /// Whether it gave up waiting for a set-point, and has had none since.
  [[nodiscard]] bool is_forsaken() const { return is_forsaken_; }
  /// Whether a set-point asked for the drop weight: once gone it is gone.
  [[nodiscard]] bool is_weight_released() const { return is_weight_released_; }
  /// Somebody takes the helm: it goes on as it was told last, takes no set-point, and says so. @param is_engaged  whether he gives it back
  void engage(bool is_engaged) { is_engaged_ = is_engaged; }
  /// A fault: it goes on as it was told last, takes set-points, and says so, and does not follow them.
  void obey(bool is_obedient) { is_obedient_ = is_obedient; }
  /// Called with every set-point that is taken.
  void tell(std::function<void(Time, const messages::Setpoint&)> listener) { listener_ = std::move(listener); }

 private:
  void tell(Time now, Frames& frames);

  Membership membership_;
  n2k::SetpointReceiver receiver_;
  vehicle::Command command_;
  Pace pace_{Duration::seconds(1)};
  std::optional<Time> last_;
  bool is_engaged_ = true;
  bool is_obedient_ = true;
  bool is_forsaken_ = false;
  bool is_weight_released_ = false;
  std::uint64_t taken_ = 0;
  std::function<void(Time, const messages::Setpoint&)> listener_;
};

}  // namespace earshot::hil
