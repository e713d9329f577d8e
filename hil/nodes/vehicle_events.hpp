#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/setpoint.hpp"
#include "hil/nodes/emulated_vehicle.hpp"

namespace earshot::hil {

/// Tells a person what becomes of an emulated vehicle: a line for each state of Earshot, each answer to an order, each decision, each new
/// course, when set-points stay away, and when one asks for the drop weight.
/// Oracle: VehicleEvents tests
class VehicleEvents {
 public:
  /// @param vehicle  outlives it
  VehicleEvents(const EmulatedVehicle& vehicle, Time began) : vehicle_(vehicle), began_(began) {}

  /// What is new since the last call: "0:12:30  Earshot is in SEARCH".
  [[nodiscard]] std::vector<std::string> lines(Time now);
  /// The whole of it: "sailed 9.3 km in 1:20:00, 4680 set-points taken".
  [[nodiscard]] std::string summary(Time now) const;

 private:
  void report_earshot(const Operator& ashore, std::vector<std::string>& lines);
  void report_course(const Autopilot& autopilot, std::vector<std::string>& lines);

  const EmulatedVehicle& vehicle_;
  Time began_;
  std::optional<messages::MissionState> state_;
  std::size_t answers_ = 0;
  std::uint64_t decisions_ = 0;
  std::optional<vehicle::Command> course_;
  bool is_forsaken_ = false;
  bool is_weight_released_ = false;
};

/// "12.50 km north, 3.20 km east"
[[nodiscard]] std::string in_kilometres(NorthEast place);

/// Hours, minutes and seconds: "1:20:00".
[[nodiscard]] std::string on_a_watch(Duration duration);

}  // namespace earshot::hil
