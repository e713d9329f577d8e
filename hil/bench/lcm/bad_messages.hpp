#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "hil/bench/bad_bus.hpp"
#include "hil/bench/fault.hpp"
#include "hil/nodes/lcm/message.hpp"

namespace earshot::hil {

/// What goes over the network for a message.
using Datagram = std::vector<std::uint8_t>;

/// Whose messages those of a channel are, as a case names them (kLcmSenders); "" of channels that nobody on the vehicle has.
[[nodiscard]] std::string_view sender_on(std::string_view channel);

/// One fault of an LCM bus, as long as it lasts.
struct MessageAffliction {
  Fault fault = Fault::kLoss;    ///< that hits messages (FaultTarget::kFrames)
  std::string_view sender = {};  ///< of kLcmSenders, outlives it; empty: all
  double share = 1.0;            ///< of these, drawn one by one
  Duration seconds = {};         ///< of kDelay, kJitter, kReplay and kDateError
};

/// What BadBus is to frames, to LCM's messages: they go in as they were said, and come out as the datagrams that arrive (LC02). The same
/// seed gives the same faults.
class BadMessages {
 public:
  explicit BadMessages(std::uint64_t seed) : random_(seed) {}

  /// @param messages  said now, in their order   @param now  never goes back
  /// @return what arrives now, in this order: first what was said before
  /// @throws NoMaker of a fault that messages cannot have
  [[nodiscard]] std::vector<Datagram> pass(const LcmMessages& messages, const std::vector<MessageAffliction>& afflictions, Time now);
  /// How often a fault did something to a message, so far.
  [[nodiscard]] std::uint64_t afflicted() const { return afflicted_; }

 private:
  struct Late {
    Time due;
    Datagram datagram;
    bool is_shuffled = false;
  };
  /// What becomes of one.
  struct Fate {
    LcmMessage message;
    Passage passage;
    bool is_cut = false;
    bool is_flipped = false;
    bool is_shuffled = false;
    std::vector<Duration> replays;
  };
  /// @return whether it did anything to the message
  [[nodiscard]] bool inject(const MessageAffliction& affliction, Fate& fate);
  [[nodiscard]] Datagram datagram_of(const Fate& fate);
  void shuffle(std::vector<Datagram>& arriving, const std::vector<std::size_t>& places);
  [[nodiscard]] bool hits(const MessageAffliction& which, const LcmMessage& message);

  Pcg32 random_;
  std::vector<Late> late_;  ///< in the order in which they were said
  std::uint32_t sequence_ = 0;
  std::uint64_t afflicted_ = 0;
};

}  // namespace earshot::hil
