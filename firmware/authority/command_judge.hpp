#pragma once

#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::authority {

/// Tells a command that is to be obeyed from one that is old, late, or was judged before: a log that is played back, a queue that empties
/// after a stall, a sender that repeats until it is acknowledged, and, where the mission names a key, a sender who does not know it.
class CommandJudge {
 public:
  CommandJudge() = default;
  explicit CommandJudge(bool needs_verified) : needs_verified_(needs_verified) {}

  struct Verdict {
    messages::CommandOutcome outcome = messages::CommandOutcome::kObeyed;
    bool is_repetition = false;  ///< judged before: the outcome is what it was then, and nothing is to be done
    bool is_from_now = false;    ///< somebody who may command says it now: it is no old recording, and verified where that is needed
  };

  enum class Sender : std::uint8_t {
    kOperator,
    kVehicle,  ///< this computer, for what its safety record holds: whoever used the number before, its order is a new one
  };

  /// kObeyed: nothing speaks against it; of an operator's remember() what became of it. Nothing speaks against an ABORT, ever: stopping
  /// once too often costs a search, not stopping may cost the vehicle. An issuer that it knows is heard by whatever it says: a repetition,
  /// too.
  [[nodiscard]] Verdict judge(Time arrival, const messages::OperatorCommand& command, Sender sender = Sender::kOperator);

  /// When there is no room for another issuer, the one that was silent for longest is forgotten; its old commands are still recognised by
  /// their dates.
  void remember(const messages::OperatorCommand& command, messages::CommandOutcome outcome);

 private:
  struct Issuer {
    std::uint32_t issuer = 0;
    std::uint32_t last_number = 0;
    messages::CommandOutcome last_outcome = messages::CommandOutcome::kObeyed;
    std::uint64_t last_heard = 0;  ///< counts what was heard of those it knows
  };

  FixedVector<Issuer, config::kMaxIssuers> issuers_;
  std::uint64_t heard_ = 0;
  bool needs_verified_ = false;
};

}  // namespace earshot::authority
