#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "hil/bench/bad_bus.hpp"
#include "hil/bench/can/rogue_nodes.hpp"
#include "hil/bench/vehicle_bus.hpp"
#include "hil/nodes/emulated_vehicle.hpp"

namespace earshot::hil {

/// A vehicle's devices on a CAN interface.
class CanVehicleBus final : public VehicleBus {
 public:
  /// All must outlive it. @throws std::system_error as host::CanSocket does
  CanVehicleBus(const Case& c, const Bench& bench, const host::MissionFile& mission);

  [[nodiscard]] std::vector<std::string> options_of_earshotd() const override { return {"--can-interface", interface_}; }
  [[nodiscard]] const vehicle::State& state() const override { return vehicle_.state(); }
  [[nodiscard]] Meters range() const override { return vehicle_.range(); }
  void disturb(const Disturbance& disturbance) override { vehicle_.disturb(disturbance); }
  void send_due(Time now) override;
  void send_again() override;
  void hear(Time now, const std::function<bool()>& is_there) override;
  void switch_interface(bool is_up) override;
  void report(BenchFlight& flight) override;

 private:
  [[nodiscard]] std::vector<Affliction> afflictions(bool of_earshot) const;
  void send(const n2k::Frame& frame);
  /// All that Earshot has said since the last.
  void receive(Frames& heard);
  /// Until Earshot has an address again, as its first question on the bus says: whose addresses are there? Or until earshotd is gone.
  void wait_for_claim(const std::function<bool()>& is_there, Frames& heard);
  void trace(const n2k::Frame& frame, bool from_earshot);

  const Case& case_;
  std::string interface_;
  EmulatedVehicle vehicle_;
  RogueNodes rogue_nodes_;
  BadBus to_earshot_;
  BadBus to_vehicle_;
  host::CanSocket socket_;
  Time now_;
  Frames arriving_;       ///< of this tick
  bool is_back_ = false;  ///< the interface: Earshot has to claim an address in this turn
  std::uint64_t sent_ = 0;
  std::uint64_t received_ = 0;
  std::deque<TracedFrame> trace_;
};

}  // namespace earshot::hil
