#pragma once

#include <cstdint>
#include <optional>

#include "firmware/boards/linux/can/arrival.hpp"
#include "firmware/boards/linux/can/can_device.hpp"
#include "firmware/boards/linux/clock/clock.hpp"
#include "firmware/boards/linux/port/input_sink.hpp"
#include "firmware/boards/linux/port/received_orders.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/runtime/runtime.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/own/orders.hpp"

namespace earshot::board {

/// Orders off the bus, and what each is answered: owns the orders in the making, who waits for an acknowledgement, and the challenge that
/// marks are made for.
class OrderInput {
 public:
  /// @param device  must outlive it
  OrderInput(std::uint8_t port, const std::optional<host::CommandProof>& proof, CanDevice& device)
      : port_(port), received_(port, proof), device_(device) {}

  void take(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink);
  /// Sends the acknowledgements of this port's orders.
  void acknowledge(const runtime::Outputs& outputs);
  /// Sends the challenge, once a period, if there is a key.
  void publish_challenge(Time now);
  /// To be called once a turn.
  void end_turn() { received_.end_turn(); }

  [[nodiscard]] std::uint64_t taken() const { return taken_; }
  /// Ours, but malformed.
  [[nodiscard]] std::uint64_t refused() const { return receiver_.counters().refused; }

 private:
  /// Who is to have the acknowledgement of an order.
  struct Asker {
    std::uint32_t issuer = 0;
    std::uint32_t number = 0;
    std::uint8_t address = n2k::kNullAddress;
  };
  void answer(const messages::CommandAcknowledgement& acknowledgement, std::uint8_t asker);

  std::uint8_t port_;
  ReceivedOrders received_;
  CanDevice& device_;
  n2k::OrderReceiver receiver_;
  std::uint64_t taken_ = 0;
  FixedVector<Asker, config::kMaxAcknowledgements> askers_;  ///< since the last turn
  std::uint8_t acknowledgement_sequence_ = 0;                ///< of the next one's packet
  std::uint8_t challenge_sequence_ = 0;                      ///< likewise
  Time challenge_published_at_;
};

}  // namespace earshot::board
