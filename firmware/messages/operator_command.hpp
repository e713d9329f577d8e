#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::messages {

enum class Order : std::uint8_t {
  kStart = 1,     ///< STANDBY -> SEARCH; while listening: takes the vehicle
  kComplete = 2,  ///< SEARCH -> DONE: the source is reached (only an operator or the simulator can know)
  kAbort = 3,     ///< any -> ABORT
  kListen = 4,    ///< STANDBY -> SEARCH that decides and commands nothing
  kPause = 5,     ///< the vehicle holds its place, and the search waits
  kResume = 6,    ///< the search goes on, from where the vehicle is
  kTighten = 7,   ///< limits of the mission become tighter, never looser
};

/// What a TIGHTEN says; what it does not say stays as it is.
struct OperatorLimits {
  std::optional<Meters> max_depth = std::nullopt;
  std::optional<MetersPerSecond> max_speed = std::nullopt;  ///< of the search, through the water
  std::optional<double> max_time_s = std::nullopt;          ///< since the search began
  friend constexpr bool operator==(const OperatorLimits&, const OperatorLimits&) = default;
};

/// A message authentication code (firmware/host/mission/authority/command_key.hpp); nothing but zeros: there is none.
using CommandMark = std::array<std::uint8_t, 16>;

/// An order of a person, or of a simulator in a person's place.
struct OperatorCommand {
  Time time;                 ///< when it was given
  Time expiry;               ///< not to be obeyed after
  std::uint32_t issuer = 0;  ///< who gave it: a number of its own, best drawn anew whenever the sender starts
  std::uint32_t number = 0;  ///< rises with every new command of the issuer, and after 2^32 - 1 comes 0; the same again is the same command
  Order order = Order::kAbort;
  OperatorLimits limits = {};  ///< of a TIGHTEN
  CommandMark mark = {};
  bool is_verified = false;   ///< the port found its mark to be that of who knows the vehicle's key, made for this start of its program
  bool has_old_mark = false;  ///< the port found it to be of who knows the key, and made for no start: it may be a recording
  friend constexpr bool operator==(const OperatorCommand&, const OperatorCommand&) = default;
};

/// How a command was judged.
enum class CommandOutcome : std::uint8_t {
  kObeyed = 0,
  kRepeated = 1,        ///< ABORT after an ABORT, PAUSE after a PAUSE: nothing was done again
  kTooOld = 2,          ///< given longer ago than config::kCommandMaxAge, or dated as far ahead
  kExpired = 3,         ///< after its own expiry
  kNotInThisState = 4,  ///< START outside STANDBY, COMPLETE outside SEARCH
  kUnknownOrder = 5,
  kNotConfigured = 6,     ///< there is no mission or no policy to fly it
  kOutOfOrder = 7,        ///< numbered behind this issuer's last: not 1 to 2^31 - 1 further
  kNotVerified = 8,       ///< the mission names a key, and the command does not bear its mark
  kNotTighter = 9,        ///< a TIGHTEN that loosens a limit, contradicts the mission, or says none
  kAutopilotSilent = 10,  ///< START while listening, and the mission's autopilot is not heard
  kOldMark = 11,          ///< as kNotVerified; its mark would be right, but lacks the vehicle's challenge
  kUnreadable = 12,       ///< its bytes are no order; a port says so, the runtime never sees it
  /// Done, but no disk has it yet: a power cut may make it forgotten. Said on the bus in place of kObeyed; the runtime never says it.
  kObeyedNotDurable = 13
};
[[nodiscard]] constexpr bool was_obeyed(CommandOutcome outcome) {
  return outcome == CommandOutcome::kObeyed || outcome == CommandOutcome::kObeyedNotDurable;
}

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
