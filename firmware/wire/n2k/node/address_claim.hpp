#pragma once

#include <bitset>
#include <cstdint>
#include <optional>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"

namespace earshot::n2k {

inline constexpr std::uint8_t kLastAddress = 251;  ///< of those that a device may claim; 252 and 253 are reserved
/// After a claim, until it holds if nobody objects. Source: SAE J1939-81, 4.2.1.
inline constexpr Duration kClaimTime = Duration::milliseconds(250);
/// Between two claims of ours, at least: two devices that claim one address at the same time disturb each other's frames, and whoever
/// claims without end must not make us do so.
inline constexpr Duration kLeastClaimGap = Duration::milliseconds(20);
/// Until a device without an address tries again: the bus may have emptied.
inline constexpr Duration kClaimAgain = Duration::seconds(30);

/// Addresses that were taken from a device after it had claimed them, each within kWarMemory of the one before, from which on somebody is
/// after it, and not after one address: it then sends from each that it has claimed until that is taken, and claims again kClaimAgainInWar
/// after it found none. SAE J1939-81 has it so for most addresses in any case (4.2.1): a device that waits for silence could be kept mute
/// for as long as somebody likes.
inline constexpr std::uint32_t kLostInWar = 3;
inline constexpr Duration kWarMemory = Duration::seconds(10);
inline constexpr Duration kClaimAgainInWar = Duration::seconds(1);

/// Before a device says that it has no address, from what made it say so: on a full bus a request for claims makes all such devices answer
/// at once, from the one address 254, and two that send at the same time disturb each other's frames. 0.6 ms times a number from 0 to 255,
/// 153 ms at most; 0.6 ms is about the length of a frame at 250 kbit/s. The number is what the NAME's eight bytes give by exclusive or:
/// devices of one maker, whose numbers differ in the lowest byte, never have the same.
/// Source: SAE J1939-81, 4.4.   Oracle: AddressClaim.WaitsBeforeItSaysThatItHasNone, by hand
[[nodiscard]] constexpr Duration cannot_claim_delay(Name name) {
  std::int64_t number = 0;
  for (unsigned i = 0; i < 8; ++i) number ^= static_cast<std::int64_t>(name >> (8U * i) & 0xFFU);
  return Duration{600 * number};
}
inline constexpr Duration kLongestCannotClaimDelay = Duration::milliseconds(153);

struct ClaimCounters {
  std::uint64_t claims = 0;    ///< sent, also those that say that no address can be claimed
  std::uint64_t defended = 0;  ///< against a device with fewer rights
  std::uint64_t lost = 0;      ///< to one with more
  std::uint64_t given_up = 0;  ///< times that no address was left
  std::uint64_t own = 0;       ///< claims with our own NAME that came back (an echo), or a device with the same NAME
};

/// Which address this device has, and how it gets and keeps one. Claims are sent by the caller: when claim_due() says so, one from
/// source().
///
///   start -> claiming -(250 ms without objection)-> holding
///   a lower NAME claims our address -> the next free one is claimed; none is free -> no address, told once, a little later; again after
///   30 s
///   a higher NAME claims our address -> our claim again
/// Source: SAE J1939-81, 4.2 to 4.4.   Oracle: AddressClaimBus tests against a plain model of the bus
class AddressClaim {
 public:
  AddressClaim(Name name, std::uint8_t preferred) : name_(name), preferred_(preferred), wanted_(preferred) {}

  /// Another device's claim (60928), or our own come back.
  void accept(std::uint8_t source, Name name, Time now);
  /// Somebody asks who is there: our claim is due, or that we cannot claim one.
  void ask(Time now);
  /// Somebody commands us (65240) to another address. kOutOfRange: no device may have that one.
  [[nodiscard]] Status move_to(std::uint8_t address);
  /// Time passes: whether a claim is to be sent now. It counts as sent.
  [[nodiscard]] bool claim_due(Time now);

  /// What we may send from; nothing while claiming, but in a war for addresses, and without one.
  [[nodiscard]] std::optional<std::uint8_t> address() const {
    const bool may_send = state_ == State::kHolding || (state_ == State::kClaiming && is_at_war_);
    return may_send ? std::optional(wanted_) : std::nullopt;
  }
  /// What a claim is to be sent from: the address claimed, or 254.
  [[nodiscard]] std::uint8_t source() const { return state_ == State::kWithout ? kNullAddress : wanted_; }
  [[nodiscard]] Name name() const { return name_; }
  [[nodiscard]] const ClaimCounters& counters() const { return counters_; }

 private:
  enum class State : std::uint8_t { kStarting, kClaiming, kHolding, kWithout };
  void yield_address(Time now);
  void note_loss(Time now);
  void claim(std::uint8_t address);

  Name name_;
  std::uint8_t preferred_;
  std::uint8_t wanted_;
  State state_ = State::kStarting;
  bool due_ = true;
  Time not_before_;                  ///< without an address: when that may be said
  std::optional<Time> sent_;         ///< our last claim
  Time began_;                       ///< the first claim of the address wanted
  Time since_;                       ///< when we were last left without an address
  std::bitset<256> taken_;           ///< by devices with more rights than ours, as far as heard
  Time lost_;                        ///< when the last was taken from us
  std::uint32_t lost_in_a_row_ = 0;  ///< each within kWarMemory of the one before
  bool is_at_war_ = false;
  ClaimCounters counters_;
};

}  // namespace earshot::n2k
