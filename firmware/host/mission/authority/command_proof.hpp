#pragma once

#include <string>
#include <string_view>

#include "firmware/core/time.hpp"
#include "firmware/host/mission/authority/command_key.hpp"
#include "firmware/host/trust/keys.hpp"
#include "firmware/messages/challenge.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::host {

/// Of this start of a program: its nonce is drawn from the system's random source.
/// @param vehicle_id  as read_vehicle_id() gives it
[[nodiscard]] messages::Challenge new_challenge(std::string_view vehicle_id, const authority::Sha256& mission);

/// The name of the vehicle that a challenge is of; empty: it has none.
[[nodiscard]] std::string vehicle_id_of(const messages::Challenge& challenge);

/// What a port knows by whether an order is of who may command the vehicle: the key, and what marks are made for besides the order.
struct CommandProof {
  CommandKey key;
  messages::Challenge challenge;
  bool accepts_old_marks =
      false;  ///< made without a challenge: a recording is obeyed after a restart, and by another vehicle with this key

  /// Says of an order, whose dates are still the sender's, what its mark is worth.
  void judge(messages::OperatorCommand& command) const;
  /// @param utc  by the wall clock, as the bus is told
  [[nodiscard]] messages::PublishedChallenge published(Time utc) const;
};

}  // namespace earshot::host
