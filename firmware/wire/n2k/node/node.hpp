#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/node/address_claim.hpp"
#include "firmware/wire/n2k/node/commanded_address.hpp"
#include "firmware/wire/n2k/node/group_function.hpp"
#include "firmware/wire/n2k/node/identity.hpp"

namespace earshot::n2k {

/// Requests refused between two steps, and group functions likewise; full: not answered, counted.
inline constexpr std::size_t kWaitingAcknowledgements = 8;
/// What one step may send: a claim, a request for claims, acknowledgements, a heartbeat, and one answer, of two fast packets at most.
inline constexpr std::size_t kNodeFrames = 3 + 2 * kWaitingAcknowledgements + 2 * kMaxFastPacketFrames;
using NodeFrames = FixedVector<Frame, kNodeFrames>;

inline constexpr Duration kHeartbeatPeriod = Duration::seconds(60);
/// Between two answers with the same information, at least: all hear an answer, whoever asked, and no storm of questions may fill the bus.
inline constexpr Duration kLeastAnswerGap = Duration::milliseconds(100);

enum class ControllerState : std::uint8_t { kErrorActive = 0, kErrorPassive = 1, kBusOff = 2 };

struct NodeCounters {
  std::uint64_t requests = 0;    ///< that concerned us
  std::uint64_t answers = 0;     ///< with information, however many asked
  std::uint64_t refused = 0;     ///< negative acknowledgements
  std::uint64_t unanswered = 0;  ///< refusals for which there was no room
  std::uint64_t commanded = 0;   ///< times that somebody gave us an address
  std::uint64_t heartbeats = 0;
};

/// A device of an NMEA 2000 network, but for what it measures and steers: it gets an address and keeps it, says who it is, what it sends
/// and reads, and that it is alive. Frames and time go in, frames come out.
///
/// Answered, to everyone and to us alone: requests (59904) for 60928, 126464, 126993, 126996 and 126998. Anything
/// else that is asked of us alone is refused (59392, NAK), what we send in its own time among it. Whatever a group function (126208) asks
/// of us alone is refused, too: nobody may change what we send. Who has no address says no more than that. Source: NMEA 2000 as documented
/// by canboat (Apache-2.0); SAE J1939-21 and -81.   Oracle: Node tests; the peer test
class Node {
 public:
  /// @param transmitted,received  PGNs for the list 126464, at most 74 each; they live as long as the node
  Node(const Identity& identity, std::span<const std::uint32_t> transmitted, std::span<const std::uint32_t> received)
      : identity_(identity), transmitted_(transmitted), received_(received), claim_(identity.name, identity.preferred_address) {}

  /// Every frame on the bus, our own among them or not.
  void accept(const HeardFrame& heard, Time now);
  /// What is to be sent now. To be called at least every 100 ms; time never goes back.
  void step(Time now, NodeFrames& frames);

  /// What to send from; nothing while there is no address: then nothing else may be sent.
  [[nodiscard]] std::optional<std::uint8_t> address() const { return claim_.address(); }
  void set_controller_state(ControllerState state) { controller_ = state; }
  [[nodiscard]] const NodeCounters& counters() const { return counters_; }
  [[nodiscard]] const ClaimCounters& claim_counters() const { return claim_.counters(); }

 private:
  enum class Answer : std::uint8_t { kProduct, kConfiguration, kLists };
  static constexpr std::size_t kAnswers = 3;
  struct Waiting {
    bool asked = false;
    std::optional<Time> sent;
    std::uint8_t sequence = 0;
  };
  struct Refusal {
    std::uint32_t pgn = 0;
    std::uint8_t asker = kNullAddress;
  };
  void take_request(const Identifier& identifier, const Frame& frame, Time now);
  void ask(Answer answer) { waiting_[static_cast<std::size_t>(answer)].asked = true; }
  void take_group_function(const Identifier& identifier, const Frame& frame);
  void send_refusals(std::uint8_t source, NodeFrames& frames);
  void send_heartbeat(std::uint8_t source, Time now, NodeFrames& frames);
  void send_one_answer(std::uint8_t source, Time now, NodeFrames& frames);
  void send(Answer answer, std::uint8_t source, NodeFrames& frames);

  Identity identity_;
  std::span<const std::uint32_t> transmitted_;
  std::span<const std::uint32_t> received_;
  AddressClaim claim_;
  CommandedAddress commanded_;
  std::array<Waiting, kAnswers> waiting_{};
  FixedVector<Refusal, kWaitingAcknowledgements> refusals_;
  FixedVector<GroupRefusal, kWaitingAcknowledgements> group_refusals_;
  std::uint8_t group_sequence_ = 0;
  bool asked_for_claims_ = false;  ///< of everyone, since we have this address
  bool heartbeat_asked_ = false;
  std::optional<Time> beat_;       ///< the last heartbeat that came in its own time; one that was asked for does not move the next
  std::optional<Time> heartbeat_;  ///< the last of either kind
  std::uint8_t heartbeat_sequence_ = 0;
  std::optional<ControllerState> controller_;
  NodeCounters counters_;
};

}  // namespace earshot::n2k
