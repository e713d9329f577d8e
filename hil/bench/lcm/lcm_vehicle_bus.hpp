#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"
#include "hil/bench/lcm/bad_messages.hpp"
#include "hil/bench/lcm/network.hpp"
#include "hil/bench/lcm/rogue_senders.hpp"
#include "hil/bench/vehicle_bus.hpp"
#include "hil/nodes/lcm/lcm_vehicle.hpp"

namespace earshot::hil {

/// A vehicle that speaks LCM, on a group of this host.
class LcmVehicleBus final : public VehicleBus {
 public:
  /// The case must outlive it. @param url  with ttl=0   @throws std::system_error as Network does
  LcmVehicleBus(const Case& c, const Bench& bench, const host::MissionFile& mission, std::string url);

  [[nodiscard]] std::vector<std::string> options_of_earshotd() const override { return {"--lcm-url", url_}; }
  [[nodiscard]] const vehicle::State& state() const override { return vehicle_.state(); }
  [[nodiscard]] Meters range() const override { return vehicle_.range(); }
  void disturb(const Disturbance& disturbance) override { vehicle_.disturb(disturbance); }
  void send_due(Time now) override;
  void send_again() override;
  void hear(Time now, const std::function<bool()>& is_there) override;
  /// Of CAN only: without the loopback interface nobody would hear the simulator's clock.
  void switch_interface(bool /*is_up*/) override {}
  void report(BenchFlight& flight) override;

 private:
  [[nodiscard]] std::vector<MessageAffliction> afflictions(bool of_earshot) const;
  void trace(const LcmMessage& message, bool from_earshot);

  const Case& case_;
  std::string url_;
  LcmVehicle vehicle_;
  RogueSenders rogue_nodes_;
  BadMessages to_earshot_;
  BadMessages to_vehicle_;
  Network network_;
  Time now_;
  LcmMessages due_;                 ///< in this tick
  std::vector<Datagram> arriving_;  ///< of it
  std::uint64_t sent_ = 0;
  std::uint64_t received_ = 0;
  std::deque<TracedMessage> trace_;
};

}  // namespace earshot::hil
