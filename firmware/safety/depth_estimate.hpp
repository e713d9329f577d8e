#pragma once

#include <optional>

#include "firmware/config/safety.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/setpoint.hpp"

namespace earshot::safety {

/// How deep the vehicle can be, by what it was told and how fast it goes down and up, and whether what its depth sensor says can be true.
/// The sensor alone never says that the vehicle has come up, and never keeps it below.
///
///   deepest' = kFastestSink down to the depth that it is told; up to it nothing for kToTurn, and then ascent_rate, while it is told a
///   speed at which it comes up; no less than a turn's last two fixes say, until it is told to come up, or when they say that it sinks
///   again by kSinksAgain
///   unexplained = |depth - told| - allowed;   allowed begins where an order finds the vehicle (a new one, or the first after it was left
///   alone), kOff further, and after kToTurn shrinks by kSlowestDive to kOff
class DepthEstimate {
 public:
  DepthEstimate() = default;
  /// Of a vehicle of which no more is known than that it is no deeper.
  explicit DepthEstimate(Meters deepest) : deepest_(deepest), deepest_of_slow_(deepest) {}

  /// What the vehicle is told from now on, once a turn; time never goes back.
  void note_order(Time now, const messages::Setpoint& setpoint, const config::VehicleLimits& vehicle);
  /// A fix that is believed.
  void take(const messages::Navigation& fix);

  /// That the vehicle can be; what the sensor says as long as it was told nothing.
  [[nodiscard]] Meters deepest() const { return deepest_; }
  /// Whether the vehicle is at the surface, by two signs: its depth says so, and it had the time to come up from the deepest place where it
  /// can be; then until its depth rises again. Or it had that time at kSlowestAscent, and for kLongestHalt its depth has not fallen: then
  /// for kRest, after which it tries again for kLongestHalt, and longer while its depth falls.
  [[nodiscard]] bool is_up(const config::VehicleLimits& vehicle) const;
  /// As deep as a vehicle gets that is told to come up from a depth.
  [[nodiscard]] static Meters while_it_turns_up(Meters depth);
  /// How much further from the depth that it is told the vehicle says that it is than one which obeys can be.
  [[nodiscard]] Meters unexplained() const;
  /// Whether nobody has told it anything for so long that it may have stopped, and come up by itself: in an outage.
  [[nodiscard]] bool is_left_alone(Time now) const { return ordered_at_ && now - *ordered_at_ > kLeftAlone; }

  static constexpr MetersPerSecond kFastestSink{3.0};  ///< heavy, or at full speed and steeply
  static constexpr MetersPerSecond kSlowestDive{0.05};
  static constexpr Duration kToTurn = Duration::seconds(60);
  static constexpr Meters kOff{25.0};  ///< of sensor and control, and as deep as a vehicle may get while it turns up
  static constexpr Meters kSinksAgain{2.0};
  static constexpr Duration kLeftAlone = Duration::seconds(5);  ///< no autopilot waits shorter for a set-point
  static constexpr Duration kLongestHalt = Duration::seconds(600);
  static constexpr Duration kRest = Duration::seconds(3000);

 private:
  void pass(Duration time, const config::VehicleLimits& vehicle);
  void check_ascent(Time now, const config::VehicleLimits& vehicle);
  void check_ascent_again(Time now, bool sinks, const config::VehicleLimits& vehicle);
  void turn_up(const config::VehicleLimits& vehicle);

  std::optional<Time> ordered_at_;
  Meters ordered_depth_;
  MetersPerSecond ordered_speed_;
  Meters depth_;                      ///< as the newest fix says
  Meters before_;                     ///< and the one before
  std::optional<Time> fixed_at_;      ///< of the newest fix
  std::optional<Time> flickered_at_;  ///< when a depth last fell faster than vehicles rise
  Meters deepest_;                    ///< by ascent_rate
  Meters deepest_of_slow_;            ///< by kSlowestAscent
  Meters allowed_{kOff};
  Duration turning_;     ///< for so long an order is not yet followed
  Duration turning_up_;  ///< likewise, by what was told alone
  Meters shallowest_;    ///< depth since it is told to come up, by a metre
  Time fell_at_;         ///< when that was
  Time stopped_at_;      ///< when it was last called up
  bool comes_up_ = false;
  bool is_up_ = false;
  bool rests_ = false;  ///< is called up by the time alone
};

}  // namespace earshot::safety
