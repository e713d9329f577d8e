#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/boards/linux/port/input_sink.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/authority/command_proof.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::board {

/// What a port of any bus does with an order before it is an input: owns by whose key marks are judged, and how many orders were answered
/// that could not be read.
class ReceivedOrders {
 public:
  /// @param proof  none: the mission names no key
  ReceivedOrders(std::uint8_t port, const std::optional<host::CommandProof>& proof) : port_(port), proof_(proof) {}

  /// Says of an order, whose dates are still the sender's, what its mark is worth, and tells a person of one that is worth nothing.
  void judge_mark(messages::OperatorCommand& command, InputSink& sink) const;
  /// Tells a person of an order that cannot be read.
  /// @param command  as much of it as can be read
  /// @return what its sender is to be told at once, because what is no order is no input; none: a flood is answered no more often in a turn
  /// than orders are
  [[nodiscard]] std::optional<messages::CommandAcknowledgement> refuse_unreadable(const messages::OperatorCommand& command, Time now,
                                                                                  InputSink& sink);
  /// To be called once a turn.
  void end_turn() { unreadable_answered_ = 0; }
  [[nodiscard]] const std::optional<host::CommandProof>& proof() const { return proof_; }

 private:
  std::uint8_t port_;
  std::optional<host::CommandProof> proof_;
  std::size_t unreadable_answered_ = 0;  ///< since the last turn
};

}  // namespace earshot::board
