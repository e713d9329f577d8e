#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot {

/// A hydrophone and an operator on a CAN bus, without addresses of their own: hears what Earshot says of itself there.
class PayloadOverCan {
 public:
  explicit PayloadOverCan(const std::string& interface) : bus_(interface, host::IfMissing::kKeepTrying) {}

  /// Says ten times a second what the hydrophone hears. @return false when it has not come true in a minute
  [[nodiscard]] bool listens_until(const std::function<bool()>& is_true) {
    for (const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1); std::chrono::steady_clock::now() < deadline;) {
      if (!bus_.is_up()) (void)bus_.reopen();
      n2k::Frame snr;
      EXPECT_EQ(n2k::compose_snr({.snr = Decibels{3.0}, .too_faint = false, .band_level = {}}, kAddress, snr), Status::kOk);
      (void)bus_.send(snr);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      listen();
      if (is_true()) return true;
    }
    return false;
  }

  void order(messages::Order order) {
    const Time now = clock_.utc();
    const messages::OperatorCommand command{
        .time = now, .expiry = now + Duration::seconds(20), .issuer = 4711, .number = ++orders_, .order = order};
    n2k::FastPacketFrames frames;
    const n2k::Route route{.source = kAddress, .destination = earshot, .sequence = static_cast<std::uint8_t>(orders_)};
    ASSERT_EQ(n2k::compose_command(command, route, frames), Status::kOk);
    for (const n2k::Frame& frame : frames) ASSERT_EQ(bus_.send(frame), Status::kOk);
  }

  messages::Health health;  ///< as it was said last, without ports
  int healths = 0;          ///< times that it was said
  std::uint8_t earshot = n2k::kNullAddress;
  std::vector<messages::PortReport> ports;
  std::vector<messages::CommandAcknowledgement> acknowledgements;
  int decisions = 0;

 private:
  static constexpr std::uint8_t kAddress = 0x29;

  void listen() {
    for (n2k::Frame frame; bus_.receive(frame) == Status::kOk;) {
      const n2k::Identifier identifier = n2k::parse_identifier(frame.identifier).value();
      std::span<const std::uint8_t> bytes;
      const bool is_ours = identifier.pgn == n2k::kPeerPgn || (identifier.pgn >= n2k::kHealthPgn && identifier.pgn <= n2k::kDecisionPgn);
      if (is_ours && assembly_.accept(identifier, frame, bytes) == Status::kOk) take(identifier, bytes);
    }
  }
  void take(const n2k::Identifier& identifier, std::span<const std::uint8_t> bytes) {
    if (const auto report = n2k::read_health(bytes); identifier.pgn == n2k::kHealthPgn && report.ok()) {
      health = report.value().health;
      earshot = identifier.source;
      ++healths;
      ports.clear();
    }
    if (const auto report = n2k::read_port_health(bytes); identifier.pgn == n2k::kPortHealthPgn && report.ok())
      ports.push_back(report.value());
    if (const auto read = n2k::read_acknowledgement(bytes); identifier.pgn == n2k::kPeerPgn && read.ok())
      acknowledgements.push_back(read.value());
    if (identifier.pgn == n2k::kDecisionPgn) ++decisions;
  }

  host::CanSocket bus_;
  n2k::FastPacketAssembly assembly_;
  board::HostClock clock_;
  std::uint32_t orders_ = 0;
};

}  // namespace earshot
