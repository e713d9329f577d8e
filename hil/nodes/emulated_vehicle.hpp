#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/wire/n2k/local_plane.hpp"
#include "hil/nodes/autopilot.hpp"
#include "hil/nodes/device.hpp"
#include "hil/nodes/hydrophone.hpp"
#include "hil/nodes/instruments.hpp"
#include "hil/nodes/operator.hpp"
#include "hil/nodes/vehicle/disturbance.hpp"
#include "hil/nodes/vehicle/moving_vehicle.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// The devices of an emulated vehicle, as they may be left out.
inline constexpr std::string_view kDeviceNames[]{"autopilot",  "compass",  "speed-log", "depth-sensor", "navigation",
                                                 "hydrophone", "operator", "altimeter", "battery",      "hull-monitor"};

struct VehicleSetup {
  vehicle::State start;
  vehicle::Limits limits = {};
  n2k::LocalPlane plane = {};                        ///< the mission's
  std::optional<MagneticField> magnetic_field = {};  ///< none: its compass is a gyrocompass
  SoundSource source = {};
  SeaFloor sea_floor{.depth = Meters{3000.0}};
  Battery battery = {};
  Meters found_within{1000.0};  ///< the operator says COMPLETE when the vehicle is no further from the source
  /// The wall clock's time, by which the operator dates its orders.
  std::function<Time()> utc = {};
  std::uint32_t issuer = 1;               ///< of the operator's orders, 16 bits
  MakeMark mark = {};                     ///< of the operator's orders, where the mission names a key
  std::uint32_t first_number = 1;         ///< unique number of the first device; the others have the next
  std::vector<std::string> without = {};  ///< of kDeviceNames: devices that are there as hardware, or not at all
};

/// A vehicle and all that is on its CAN bus but Earshot, as one device: the vehicle moves as its autopilot says, its instruments tell where
/// it is, the hydrophone hears the source, the operator starts the search and ends it at the source. The devices hear each other.
class EmulatedVehicle final {
 public:
  explicit EmulatedVehicle(const VehicleSetup& setup);
  EmulatedVehicle(const EmulatedVehicle&) = delete;
  EmulatedVehicle& operator=(const EmulatedVehicle&) = delete;

  /// Every frame on the bus that did not come from here.
  void accept(const n2k::Frame& frame, Time now);
  /// The vehicle moves on, and its devices say what is due. To be called at least every 100 ms of its time, which never goes back.
  void step(Time now, Frames& frames);
  /// From the next step on.
  void disturb(const Disturbance& disturbance);

  [[nodiscard]] const vehicle::State& state() const { return moving_.state(); }
  [[nodiscard]] Meters range() const;  ///< horizontal, to the source
  [[nodiscard]] Meters sailed() const { return moving_.sailed(); }
  [[nodiscard]] double battery_percent() const { return moving_.battery_percent(); }
  [[nodiscard]] std::vector<std::string_view> devices() const;
  /// Of the device of that name (kDeviceNames); nothing while it has none, or was left out.
  [[nodiscard]] std::optional<std::uint8_t> address_of(std::string_view device) const;
  /// Null where it was left out.
  [[nodiscard]] Autopilot* autopilot() const { return autopilot_; }
  [[nodiscard]] Operator* operator_ashore() const { return operator_; }

 private:
  MovingVehicle moving_;
  vehicle::Command resting_;
  NorthEast source_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::vector<std::string_view> names_;  ///< of these, of kDeviceNames
  Autopilot* autopilot_ = nullptr;       ///< among devices_
  Operator* operator_ = nullptr;         ///< likewise
};

}  // namespace earshot::hil
