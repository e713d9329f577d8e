#pragma once

#include <cstdint>

#include "firmware/core/time.hpp"

namespace earshot::messages {

enum class Order : std::uint8_t {
  kStart = 1,     ///< STANDBY -> SEARCH
  kComplete = 2,  ///< SEARCH -> DONE: the source is reached (only an operator or the simulator can know)
  kAbort = 3,     ///< any -> ABORT
};

/// An order of a person, or of a simulator in a person's place.
struct OperatorCommand {
  Time time;                 ///< when it was given
  Time expiry;               ///< not to be obeyed after
  std::uint32_t issuer = 0;  ///< who gave it: a number of its own, best drawn anew whenever the sender starts
  std::uint32_t number = 0;  ///< rises with every new command of the issuer, to 2^32 - 1 at most; the same again is the same command
  Order order = Order::kAbort;
  friend constexpr bool operator==(const OperatorCommand&, const OperatorCommand&) = default;
};

/// How a command was judged.
enum class CommandOutcome : std::uint8_t {
  kObeyed = 0,
  kRepeated = 1,        ///< ABORT after an ABORT: nothing was done again
  kTooOld = 2,          ///< given longer ago than config::kCommandMaxAge, or dated as far ahead
  kExpired = 3,         ///< after its own expiry
  kNotInThisState = 4,  ///< START outside STANDBY, COMPLETE outside SEARCH
  kUnknownOrder = 5,
  kNotConfigured = 6,  ///< there is no mission or no policy to fly it
  kOutOfOrder = 7,     ///< numbered below this issuer's last
};

/// Goes back to whoever gave the command.
struct CommandAcknowledgement {
  Time time;              ///< when it was judged
  std::uint8_t port = 0;  ///< it came by, and its acknowledgement leaves by
  std::uint32_t issuer = 0;
  std::uint32_t number = 0;
  Order order = Order::kAbort;
  CommandOutcome outcome = CommandOutcome::kObeyed;
  friend constexpr bool operator==(const CommandAcknowledgement&, const CommandAcknowledgement&) = default;
};

}  // namespace earshot::messages
