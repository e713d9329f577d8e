#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "firmware/core/time.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "hil/nodes/emulated_vehicle.hpp"
#include "hil/nodes/scaled_clock.hpp"

namespace earshot::hil {

/// Frames that wait until the interface takes them, as in a device's own buffer; full: the newest goes, counted.
inline constexpr std::size_t kWaitingFrames = 128;

/// Puts an emulated vehicle on a CAN interface.
class BusConnection {
 public:
  /// All must outlive it. @throws std::system_error as host::CanSocket does; an interface that is missing is waited for.
  BusConnection(const std::string& interface, EmulatedVehicle& vehicle, const ScaledClock& clock);

  /// Waits for a frame, but no longer than a device's shortest period, gives what has come to the vehicle, and sends what it says.
  void turn();

  [[nodiscard]] bool is_up() const { return socket_.is_up(); }
  [[nodiscard]] std::uint64_t sent() const { return socket_.counters().sent; }  ///< frames
  [[nodiscard]] std::uint64_t received() const { return socket_.counters().received; }
  [[nodiscard]] std::uint64_t lost() const { return lost_ + socket_.counters().lost_by_kernel; }  ///< either way

 private:
  void wait() const;
  void receive();
  void send();

  host::CanSocket socket_;
  EmulatedVehicle& vehicle_;
  const ScaledClock& clock_;
  Frames sent_;
  std::deque<n2k::Frame> waiting_;
  std::optional<Time> reopened_;
  std::uint64_t lost_ = 0;
};

}  // namespace earshot::hil
