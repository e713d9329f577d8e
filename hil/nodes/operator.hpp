#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/messages/challenge.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "hil/nodes/device.hpp"
#include "hil/nodes/membership.hpp"
#include "hil/nodes/pace.hpp"

namespace earshot::hil {

/// How long after it was given an order may be obeyed and is repeated, by the wall clock.
inline constexpr Duration kOrderLife = Duration::seconds(30);

/// Marks an order for what the vehicle tells (firmware/authority/README.md). Nothing: that is not the vehicle that is meant.
using MakeMark = std::function<std::optional<messages::CommandMark>(const messages::OperatorCommand&, const messages::PublishedChallenge&)>;

struct OperatorSetup {
  std::uint32_t issuer = 1;  ///< 16 bits, best drawn anew for every start
  /// The wall clock's time, by which orders are dated.
  std::function<Time()> utc;
  /// Whether the source is reached, which nobody aboard can know; empty: it never is.
  std::function<bool()> has_arrived;
  std::uint32_t unique_number = 0;
  MakeMark mark = {};  ///< where the mission names a key: nothing but an ABORT is said before the vehicle's challenge (130953) is heard
};

/// A person at the other end of a modem on the bus (126720): says START when Earshot is in STANDBY, COMPLETE when the source is reached,
/// and ABORT when asked to; repeats an order once a second until it is acknowledged. Earshot is found by its health (130950), which it
/// sends; until that is heard nothing is said.
class Operator final : public Device {
 public:
  explicit Operator(OperatorSetup setup);

  [[nodiscard]] std::string_view name() const override { return membership_.model(); }
  [[nodiscard]] std::optional<std::uint8_t> address() const override { return membership_.address(); }
  void accept(const n2k::Frame& frame, Time now) override;
  void step(Time now, Frames& frames) override;

  /// An ABORT, in one frame; to everyone while nobody is known to be Earshot.
  void abort();

  /// What Earshot said last of itself, and how it answered; nothing that it did not say over this bus.
  [[nodiscard]] const std::optional<n2k::HealthReport>& health() const { return health_; }
  [[nodiscard]] std::optional<std::uint8_t> vehicle() const { return vehicle_; }  ///< Earshot's address
  [[nodiscard]] const std::optional<messages::Decision>& decision() const { return decision_; }
  [[nodiscard]] std::uint64_t decisions() const { return decisions_; }
  [[nodiscard]] const std::vector<messages::CommandAcknowledgement>& answers() const { return answers_; }
  [[nodiscard]] std::uint64_t sent() const { return sent_; }  ///< orders, repetitions too

 private:
  struct Waiting {
    messages::OperatorCommand command;
    Pace pace{Duration::seconds(1)};
  };
  void take_health(std::uint8_t source, const n2k::HealthReport& report);
  void take_answer(const messages::CommandAcknowledgement& answer, Time now);
  void give(messages::Order order);
  void give_what_is_due(Time now);
  void forget_expired();
  [[nodiscard]] bool is_waiting(messages::Order order) const;
  [[nodiscard]] Status send(Waiting& waiting, std::uint8_t source, Frames& frames);

  OperatorSetup setup_;
  Membership membership_;
  n2k::FastPacketAssembly assembly_;
  std::optional<std::uint8_t> vehicle_;
  std::optional<n2k::HealthReport> health_;
  std::optional<messages::PublishedChallenge> challenge_;  ///< that the vehicle told last
  std::optional<messages::Decision> decision_;
  std::uint64_t decisions_ = 0;
  std::vector<messages::CommandAcknowledgement> answers_;
  std::vector<Waiting> waiting_;
  bool has_started_ = false;    ///< START was given since Earshot came into STANDBY
  bool has_completed_ = false;  ///< COMPLETE was given since
  Time rests_until_;            ///< after a refusal
  std::uint32_t number_ = 0;
  std::uint8_t sequence_ = 0;
  std::uint64_t sent_ = 0;
};

}  // namespace earshot::hil
