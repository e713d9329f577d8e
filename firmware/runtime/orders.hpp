#pragma once

#include <cstdint>

#include "firmware/authority/command_judge.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/runtime/outputs.hpp"

namespace earshot::runtime {

/// Which commands came, and what became of each. Owns the judge of old, late and repeated ones, the acknowledgements that leave with the
/// next turn, and the count of what was refused. What an order does is not its business. Oracle: Orders.*
class Orders {
 public:
  /// A command as it came in.
  struct Arrival {
    Time time;
    std::uint8_t port = 0;
    const messages::OperatorCommand& command;
  };
  using Verdict = authority::CommandJudge::Verdict;

  Orders() = default;
  explicit Orders(bool needs_verified_commands) : judge_(needs_verified_commands) {}

  /// Whether the command is to be obeyed: kObeyed, and no repetition.
  [[nodiscard]] Verdict judge(const Arrival& arrival);
  /// Counts what was refused, remembers what became of an operator's order, and acknowledges it.
  /// @param verdict  judge()'s
  /// @param outcome  what became of it; the verdict's where it was not obeyed
  void answer(const Arrival& arrival, const Verdict& verdict, messages::CommandOutcome outcome);

  /// Those that wait; none does afterwards.
  void move_acknowledgements_to(Acknowledgements& acknowledgements);
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

 private:
  void acknowledge(const messages::CommandAcknowledgement& acknowledgement);

  authority::CommandJudge judge_;
  Acknowledgements waiting_;
  std::uint64_t refused_ = 0;  ///< with another outcome than obeyed or repeated
};

}  // namespace earshot::runtime
