#pragma once

#include <cstdint>
#include <memory>

#include "firmware/boards/linux/mission_file.hpp"
#include "firmware/core/time.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// Counters of the bus as the runtime sees it; they only grow.
struct BusCounters {
  std::uint64_t navigation_messages = 0;  ///< fixes received
  std::uint64_t refused_messages = 0;     ///< malformed
  std::uint64_t setpoint_messages = 0;    ///< set-points sent
  std::uint64_t unsent_messages = 0;      ///< refused by the kernel or not representable on the bus
};

/// The vehicle's bus: navigation in, set-points out, and where the bus can carry them also orders and SNR in, decisions and health out.
/// Nothing waits and, after construction, nothing allocates.
class VehicleBus {
 public:
  VehicleBus() = default;
  virtual ~VehicleBus() = default;
  VehicleBus(const VehicleBus&) = delete;
  VehicleBus& operator=(const VehicleBus&) = delete;

  /// Puts the newest of each kind that has arrived into `inputs`; what has not arrived stays as it is.
  virtual void collect(Time now, runtime::Inputs& inputs) = 0;
  virtual void publish(Time now, const runtime::Outputs& outputs) = 0;
  /// For poll().
  [[nodiscard]] virtual int file_descriptor() const = 0;
  [[nodiscard]] const BusCounters& counters() const { return counters_; }

 protected:
  void count_sent(Status status, std::uint64_t& sent) { ++(status == Status::kOk ? sent : counters_.unsent_messages); }
  BusCounters counters_;
};

/// The bus that the mission asks for. @throws std::system_error naming what cannot be opened.
[[nodiscard]] std::unique_ptr<VehicleBus> open_vehicle_bus(const MissionFile& mission);

}  // namespace earshot::board
