#pragma once

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "hil/nodes/hydrophone.hpp"
#include "hil/nodes/instruments.hpp"
#include "hil/nodes/lcm/message.hpp"
#include "hil/nodes/vehicle/helm.hpp"
#include "hil/nodes/vehicle/moving_vehicle.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

struct LcmVehicleSetup {
  vehicle::State start;
  vehicle::Limits limits = {};
  SoundSource source = {};
  SeaFloor sea_floor{.depth = Meters{3000.0}};
  Battery battery = {};
};

/// A vehicle whose devices speak LCM: messages and time go in, messages come out. It moves as set-points say (EARSHOT_SETPOINT), and says
/// every time that it is asked, dated with that time: where it is, what its hydrophone hears, how its hull is, and whether its autopilot
/// follows.
class LcmVehicle {
 public:
  explicit LcmVehicle(const LcmVehicleSetup& setup);

  /// Every message on the bus that is not its own. A set-point that is none, or that no vehicle can follow (Helm::take), is not taken.
  void accept(const LcmMessage& message, Time now);
  /// It moves on, and adds what it says. To be called with a time that never goes back.
  void step(Time now, LcmMessages& sent);
  /// From the next step on.
  void disturb(const Disturbance& disturbance);

  [[nodiscard]] const vehicle::State& state() const { return moving_.state(); }
  [[nodiscard]] Meters range() const;  ///< horizontal, to the source
  [[nodiscard]] const Helm& helm() const { return helm_; }

 private:
  void hear(Time now, LcmMessages& sent) const;
  void publish_hull(Time now, LcmMessages& sent) const;

  MovingVehicle moving_;
  Helm helm_;
  SoundSource source_;
  SeaFloor sea_floor_;
};

}  // namespace earshot::hil
