#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "firmware/core/time.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "hil/bench/bench_flight.hpp"

namespace earshot::hil {

/// Hears what a vehicle and Earshot say to each other on a CAN interface, and says nothing.
class BusReader {
 public:
  /// @throws std::system_error as host::CanSocket does
  explicit BusReader(const std::string& interface) : socket_(interface) {}

  /// All that has come since the last call, dated `now`.
  void hear(Time now);
  /// What was traced up to now.
  void forget() { trace_.clear(); }
  /// What Earshot said last of itself; nothing while it is not heard.
  [[nodiscard]] const std::optional<messages::Health>& health() const { return health_; }
  /// The interface was down, and is there again.
  void come_back() { (void)socket_.reopen(); }
  void report(BenchFlight& flight);

 private:
  void take(const n2k::Frame& frame, Time now);

  host::CanSocket socket_;
  n2k::FastPacketAssembly assembly_;
  std::optional<std::uint8_t> earshot_;  ///< its address
  std::optional<messages::Health> health_;
  std::uint64_t of_vehicle_ = 0;  ///< frames
  std::uint64_t of_earshot_ = 0;
  std::deque<TracedFrame> trace_;
};

}  // namespace earshot::hil
