#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "firmware/boards/linux/can/arrival.hpp"
#include "firmware/boards/linux/can/autopilot_input.hpp"
#include "firmware/boards/linux/can/can_device.hpp"
#include "firmware/boards/linux/can/order_input.hpp"
#include "firmware/boards/linux/can/snr_input.hpp"
#include "firmware/boards/linux/can/status_output.hpp"
#include "firmware/boards/linux/can/surface_zero.hpp"
#include "firmware/boards/linux/can/trouble_report.hpp"
#include "firmware/boards/linux/can/vehicle_input.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/boards/linux/port/port.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/host/transport/if_missing.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::board {

/// All that the runtime takes and gives but sound, as a device of an NMEA 2000 network (firmware/wire/n2k). Owns that device, what reads
/// each kind of message off the bus, and what sends each; gives every frame to the reader that its group and the port's roles name, and
/// sums up their counts. Measurements bear no date: the kernel's of their arrival stands for it; orders bear their own.
class CanPort final : public Port, public BusMember {
 public:
  /// @param host  its monotonic clock times what the bus wants of a device: heartbeats do not run faster with a rehearsal's mission clock.
  /// Must outlive the port.
  /// @throws std::system_error as CanSocket does.
  CanPort(std::uint8_t index, const host::PortSettings& settings, const n2k::LocalPlane& plane, const HostClock& host,
          host::IfMissing if_missing = host::IfMissing::kRefuse);

  void collect(Clock& clock, InputSink& sink) override;
  std::uint64_t publish(Time now, const runtime::Outputs& outputs) override;
  [[nodiscard]] int file_descriptor() const override { return device_.file_descriptor(); }
  void tend() override { device_.tend(); }
  [[nodiscard]] messages::PortReport report() const override;
  [[nodiscard]] std::size_t memory() const override { return sizeof *this; }
  [[nodiscard]] PortWords words() const override { return {.label = label_, .remark = remark()}; }
  [[nodiscard]] FurtherDuties further_duties() override { return {.bus_member = this}; }
  void serve() override { device_.serve(); }
  [[nodiscard]] bool settle() override;

 private:
  void take(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink);
  void count_refusal(Status status);
  [[nodiscard]] bool publish_setpoint(const messages::Setpoint& setpoint);
  [[nodiscard]] BusSigns signs() const;
  [[nodiscard]] std::string remark() const;

  std::string label_;
  CanDevice device_;
  VehicleInput vehicle_;
  SurfaceZero surface_zero_;
  SnrInput snr_;
  AutopilotInput autopilot_;
  OrderInput orders_;
  std::uint8_t setpoint_sequence_ = 0;  ///< of the next one's packet
  StatusOutput status_;
  TroubleReport troubles_;
};

}  // namespace earshot::board
