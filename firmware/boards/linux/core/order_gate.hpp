#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::board {

/// How many orders a bus may give: what comes faster is not taken, so that a flood of orders that are refused fills neither the journal nor
/// the turns. Orders with the mark of the vehicle's key have a share of their own, which no stranger can use up. An ABORT always goes
/// through until the mission has ended by one. Oracle: OrderGate.*
class OrderGate {
 public:
  static constexpr std::int64_t kAtOnce = 32;
  static constexpr Duration kBetween = Duration::milliseconds(50);  ///< 20 a second

  /// @param now  never goes back
  [[nodiscard]] bool lets_through(const messages::OperatorCommand& order, Time now, bool is_aborted) {
    if (order.order == messages::Order::kAbort && !is_aborted) return true;
    Time& due = order.is_verified ? marked_due_ : due_;
    if (due - now > Duration{(kAtOnce - 1) * kBetween.us}) return false;
    due = std::max(due, now) + kBetween;
    return true;
  }

 private:
  Time due_;  ///< when its orders would have come, were there one in kBetween
  Time marked_due_;
};

}  // namespace earshot::board
