#pragma once

#include <cstdint>
#include <memory>

#include "firmware/boards/linux/input_sink.hpp"
#include "firmware/boards/linux/mission_file.hpp"
#include "firmware/core/time.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::board {

/// Counters of the bus as the runtime sees it; they only grow.
struct BusCounters {
  std::uint64_t refused_messages = 0;   ///< malformed, dated wrongly, or lost because they came faster than they were taken
  std::uint64_t setpoint_messages = 0;  ///< set-points sent
  std::uint64_t unsent_messages = 0;    ///< refused by the kernel or not representable on the bus
};

/// The vehicle's bus: navigation in, set-points out, and where the bus can carry them also orders and SNR in, decisions and health out.
/// Nothing but wait() waits and, after construction, nothing allocates.
class VehicleBus {
 public:
  VehicleBus() = default;
  virtual ~VehicleBus() = default;
  VehicleBus(const VehicleBus&) = delete;
  VehicleBus& operator=(const VehicleBus&) = delete;

  /// Gives `sink` all that has arrived, in order of arrival.
  virtual void collect(Time now, InputSink& sink) = 0;
  virtual void publish(Time now, const runtime::Outputs& outputs) = 0;
  /// Until collect() has something to read, but no longer than `most`.
  virtual void wait(Duration most) = 0;
  [[nodiscard]] BusCounters counters() const {
    BusCounters counters = counters_;
    counters.refused_messages += refused_below();
    return counters;
  }
  /// For who takes from collect() and refuses a message.
  void count_refused() { ++counters_.refused_messages; }

 protected:
  /// What socket and transport refused or lost.
  [[nodiscard]] virtual std::uint64_t refused_below() const { return 0; }
  void count_sent(Status status, std::uint64_t& sent) { ++(status == Status::kOk ? sent : counters_.unsent_messages); }
  BusCounters counters_;
};

/// The bus that the mission asks for. @throws std::system_error naming what cannot be opened.
[[nodiscard]] std::unique_ptr<VehicleBus> open_vehicle_bus(const MissionFile& mission);

}  // namespace earshot::board
