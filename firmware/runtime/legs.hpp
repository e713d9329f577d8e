#pragma once

#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/guidance/leg.hpp"

namespace earshot::runtime {

/// The legs of one search. Owns the present leg and when it was decided, whether an order or a rule has cut it short, and how many were
/// decided and sailed.
/// Oracle: Legs.*
class Legs {
 public:
  /// A decision was made.
  void begin(const guidance::Leg& leg, Time now);
  /// A step of the search is over.
  void count_step() { ++steps_taken_; }
  /// The vehicle is not where the leg would have led it: the search decides anew.
  void interrupt() { is_interrupted_ = true; }
  /// It does so now, from where the vehicle is.
  void decide_anew() { is_interrupted_ = false; }

  [[nodiscard]] const guidance::Leg& present() const { return leg_; }
  /// False before the first decision.
  [[nodiscard]] bool has_begun() const { return leg_.length().value > 0.0; }
  [[nodiscard]] bool is_interrupted() const { return is_interrupted_; }
  /// Whether a vehicle that sails the present leg from its decision on at `speed` has come to its end.
  [[nodiscard]] bool would_be_over(Time now, MetersPerSecond speed) const;
  [[nodiscard]] std::uint32_t decisions() const { return decisions_; }
  [[nodiscard]] std::uint32_t steps_taken() const { return steps_taken_; }

 private:
  guidance::Leg leg_;
  Time decided_;
  std::uint32_t decisions_ = 0;
  std::uint32_t steps_taken_ = 0;
  bool is_interrupted_ = false;
};

}  // namespace earshot::runtime
