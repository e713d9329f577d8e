#pragma once

#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::runtime {

/// Tells a command that is to be obeyed from one that is old, late, or was judged before: a log that is played back, a queue that empties
/// after a stall, a sender that repeats until it is acknowledged.
class CommandJudge {
 public:
  /// kObeyed: nothing speaks against it. Its number is remembered, so that the same command a second time is kRepeated.
  /// Nothing speaks against an ABORT, ever: stopping once too often costs a search, not stopping may cost the vehicle.
  [[nodiscard]] messages::CommandOutcome judge(Time arrival, const messages::OperatorCommand& command);

 private:
  struct Issuer {
    std::uint32_t issuer = 0;
    std::uint32_t last_number = 0;
  };

  FixedVector<Issuer, config::kMaxIssuers> issuers_;
};

}  // namespace earshot::runtime
