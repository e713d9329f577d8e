#pragma once

#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"

namespace earshot::n2k {

// What the vehicle says of itself: fast packets to everyone. Composing fails with kOutOfRange where a number does not fit its field (places
// beyond 21 474 km); counters beyond 48 bits stay at their highest. Reading fails as decode() does, and with kUnsupported for another
// maker's message.

/// A sender's address and the number of its packet, one higher for every packet of the same group.
struct Sender {
  std::uint8_t source = kNullAddress;
  std::uint8_t sequence = 0;
};

/// Without its ports: each has a message of its own.
[[nodiscard]] Status compose_health(const messages::Health& health, Time now, const Sender& sender, FastPacketFrames& frames);
struct HealthReport {
  Time time;
  messages::Health health;  ///< without its ports, and without what older vehicles do not say: found, sweeping, mismatch, response
  std::uint8_t port_count = 0;
};
[[nodiscard]] Result<HealthReport> read_health(std::span<const std::uint8_t> bytes);

[[nodiscard]] Status compose_port_health(const messages::PortReport& report, const Sender& sender, FastPacketFrames& frames);
[[nodiscard]] Result<messages::PortReport> read_port_health(std::span<const std::uint8_t> bytes);

/// Without observation and logits, which the journal has.
[[nodiscard]] Status compose_decision(const messages::Decision& decision, const Sender& sender, FastPacketFrames& frames);
[[nodiscard]] Result<messages::Decision> read_decision(std::span<const std::uint8_t> bytes);

}  // namespace earshot::n2k
