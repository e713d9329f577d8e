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
#include "hil/nodes/vehicle/helm.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

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

  [[nodiscard]] const vehicle::Command& command() const { return helm_.command(); }
  [[nodiscard]] std::uint64_t taken() const { return helm_.taken(); }  ///< set-points
  /// Whether it gave up waiting for a set-point, and has had none since.
  [[nodiscard]] bool is_forsaken() const { return helm_.is_forsaken(); }
  /// Whether a set-point asked for the drop weight: once gone it is gone.
  [[nodiscard]] bool is_weight_released() const { return helm_.is_weight_released(); }
  /// Somebody takes the helm: it goes on as it was told last, takes no set-point, and says so. @param is_engaged  whether he gives it back
  void engage(bool is_engaged) { helm_.engage(is_engaged); }
  /// A fault: it goes on as it was told last, takes set-points, and says so, and does not follow them.
  void obey(bool is_obedient) { helm_.obey(is_obedient); }
  /// Called with every set-point that is taken.
  void call_back(std::function<void(Time, const messages::Setpoint&)> on_setpoint) { on_setpoint_ = std::move(on_setpoint); }

 private:
  void publish(Time now, Frames& frames);

  Membership membership_;
  n2k::SetpointReceiver receiver_;
  Helm helm_;
  Pace pace_{Duration::seconds(1)};
  std::function<void(Time, const messages::Setpoint&)> on_setpoint_;
};

}  // namespace earshot::hil
