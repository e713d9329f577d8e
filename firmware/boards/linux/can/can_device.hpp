#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware/boards/linux/can/bus_roles.hpp"
#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/port_settings.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/node/node.hpp"

namespace earshot::board {

/// Between two messages of a period, at least: the period, less what turns of one second are apart from a second.
constexpr Duration least_between(Duration period) {
  return {period.us * 9 / 10};
}

/// Earshot as a device of its NMEA 2000 network: owns the socket, the NAME and the address that is claimed with it, and counts the messages
/// that could not be sent. It sends nothing but claims as long as it has no address.
class CanDevice {
 public:
  /// @param host  must outlive it
  /// @throws std::system_error as CanSocket does.
  CanDevice(const host::PortSettings& settings, const HostClock& host, host::IfMissing if_missing);
  CanDevice(const CanDevice&) = delete;  // the node refers to it
  CanDevice& operator=(const CanDevice&) = delete;

  /// Gives `take(heard frame, when it arrived by the wall clock)` what has arrived, at most kCanFramesPerCollect frames.
  template <class Take>
  void read(Take take);
  /// Sends one message, or counts that it could not. What waits for room is sent, or counted by the socket.
  /// @param compose  Status(address to send from, Frames&)
  /// @return false: it is not sent, and never will be
  template <class Frames, class Compose>
  bool send(Compose compose, const host::Waiting& waiting = {});
  /// Does what the bus wants of a device: claims, answers, heartbeats.
  void serve();
  /// Tries to be on a bus again that went down.
  void tend() {
    if (!socket_.is_up()) (void)socket_.reopen();
  }

  [[nodiscard]] bool is_up() const { return socket_.is_up(); }
  /// -1 while the link is down.
  [[nodiscard]] int file_descriptor() const { return is_up() ? socket_.file_descriptor() : -1; }
  /// None: only what is meant for all is for us.
  [[nodiscard]] std::optional<std::uint8_t> address() const { return node_.address(); }
  /// By the host's monotonic clock.
  [[nodiscard]] Time now() const { return Time{} + host_.monotonic(); }
  /// By the host's wall clock.
  [[nodiscard]] Time utc() const { return host_.utc(); }

  /// Adds the link's state, and what was lost on it either way.
  void add_to(messages::PortReport& report) const;
  [[nodiscard]] host::CanCounters counters() const { return socket_.counters(); }
  [[nodiscard]] n2k::ControllerState controller_state() const { return socket_.controller_state(); }
  /// Claims with our NAME that others sent.
  [[nodiscard]] std::uint64_t own_name_claims() const { return node_.claim_counters().own; }
  /// Messages that were not sent for want of an address.
  [[nodiscard]] std::uint64_t without_address() const { return without_address_; }

 private:
  [[nodiscard]] n2k::Node new_node() const { return {identity_, pgns_sent_.span(), pgns_read_.span()}; }
  [[nodiscard]] bool pass_to_socket(std::span<const n2k::Frame> frames, const host::Waiting& waiting = {});

  const HostClock& host_;
  std::string software_version_;  ///< identity_ refers to both texts
  std::string serial_;
  n2k::Identity identity_;
  Pgns pgns_sent_;
  Pgns pgns_read_;
  host::CanSocket socket_;
  bool was_up_;  ///< when it was served last
  n2k::Node node_;
  std::uint64_t unsent_ = 0;           ///< messages that the socket did not take
  std::uint64_t without_address_ = 0;  ///< of these
};

template <class Take>
void CanDevice::read(Take take) {
  std::size_t budget = config::kCanFramesPerCollect;
  const Time now = this->now();
  Time received_utc;
  for (n2k::Frame frame; socket_.receive(frame, received_utc, budget) == Status::kOk;) {
    const n2k::HeardFrame heard(frame);
    node_.accept(heard, now);
    take(heard, received_utc < Time{} ? utc() : received_utc);  // negative: the kernel does not say
  }
}

template <class Frames, class Compose>
bool CanDevice::send(Compose compose, const host::Waiting& waiting) {
  const std::optional<std::uint8_t> address = node_.address();
  if (!address && socket_.is_up()) ++without_address_;
  Frames frames;
  if (address && compose(*address, frames) == Status::kOk && pass_to_socket(frames.span(), waiting)) return true;
  ++unsent_;
  return false;
}

}  // namespace earshot::board
