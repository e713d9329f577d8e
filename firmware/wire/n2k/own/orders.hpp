#pragma once

#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"

namespace earshot::n2k {

// Orders to the vehicle and its answers: group 126720, from one device to one other.

/// Who tells whom.
struct Route {
  std::uint8_t source = kNullAddress;
  std::uint8_t destination = kBroadcast;
  std::uint8_t sequence = 0;  ///< one higher for every packet
};

[[nodiscard]] Status compose_command(const messages::OperatorCommand& command, const Route& route, FastPacketFrames& frames);
/// An order that nobody knows comes as it is: its sender is to hear so. kUnsupported: not ours. Fails as decode() does.
[[nodiscard]] Result<messages::OperatorCommand> read_command(std::span<const std::uint8_t> bytes);

/// One frame that aborts. kOutOfRange: an issuer over 16 bits or a number over 24.
[[nodiscard]] Status compose_abort(std::uint32_t issuer, std::uint32_t number, const Route& route, Frame& frame);

[[nodiscard]] Status compose_acknowledgement(const messages::CommandAcknowledgement& acknowledgement, const Route& route,
                                             FastPacketFrames& frames);
/// Without the port, which the bus does not carry.
[[nodiscard]] Result<messages::CommandAcknowledgement> read_acknowledgement(std::span<const std::uint8_t> bytes);

struct OrderCounters {
  std::uint64_t taken = 0;
  std::uint64_t cut = 0;      ///< of these, aborts whose other fields could not be read
  std::uint64_t refused = 0;  ///< ours, but malformed
  std::uint64_t other = 0;    ///< other makers' messages of this group, and orders to all but aborts
};

/// Takes orders off the bus: fast packets, and single frames too, as some senders put short messages of this group. Told apart by our
/// maker's code in a frame's first two bytes, which would otherwise be the 29th of a packet or later; a packet that is that far goes on.
class OrderReceiver {
 public:
  /// @param address  ours: what is sent to others is not for us, and of what is sent to all only an abort
  /// @return kOk: `command` is new, and `sender` is to have its acknowledgement. kNotReady: nothing came of it. Otherwise refused and
  /// counted: of `command` there are issuer, number and order, as far as they are readable, to answer by. A command whose order is an ABORT
  /// is never refused, whatever else of it is missing or impossible.
  [[nodiscard]] Status accept(const HeardFrame& heard, Time now, std::uint8_t address, messages::OperatorCommand& command,
                              std::uint8_t& sender);

  [[nodiscard]] const OrderCounters& counters() const { return counters_; }

 private:
  [[nodiscard]] Status take(std::span<const std::uint8_t> bytes, Time now, messages::OperatorCommand& command);

  FastPacketAssembly assembly_;
  OrderCounters counters_;
};

}  // namespace earshot::n2k
