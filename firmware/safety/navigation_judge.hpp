#pragma once

#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/navigation.hpp"

namespace earshot::safety {

/// Tells a fix that may be true from one that cannot be. One that lies where the vehicle cannot have gone since the last, or since a minute
/// ago (a stray echo, a second sender, a place that creeps away), is refused and remembered; fixes that go on from a refused one, and lie
/// no further off than a dead reckoning that is put right may jump, are believed after a while.
class NavigationJudge {
 public:
  /// @param timeout  the mission's: a fix dated longer before its arrival is refused
  NavigationJudge(const config::VehicleLimits& vehicle, Duration timeout) : vehicle_(vehicle), timeout_(timeout) {}
  NavigationJudge() = default;

  /// @param arrival   when the fix arrived; never goes back
  /// @param is_to_move  whether the vehicle is told to move; one that is not may have been carried: once the newest fix is too old, any is
  /// believed
  /// @return whether it is believed; then it is newest(), dated no later than its arrival
  [[nodiscard]] bool take(Time arrival, const messages::Navigation& fix, bool is_to_move);

  [[nodiscard]] const std::optional<messages::Navigation>& newest() const { return newest_; }

  /// Whether newest() goes on from no fix before: it puts a dead reckoning right, or the vehicle was carried.
  [[nodiscard]] bool newest_is_correction() const { return newest_is_correction_; }

  /// How far the newest refused fix lay from where the vehicle can have been, or one before it that lay more than kMostNoise off; none once
  /// no such fix was refused for kJumpMemory, and none as long as no more than kNoisyShare of the fixes are, and by no more than
  /// kMostNoise: that is noise. Once three that lay further off have gone on from each other they are a sender's, and one that is slower
  /// than kJumpMemory is remembered for twice the time between its fixes.
  [[nodiscard]] Meters jump(Time now) const;
  /// For how long fixes have said one place although the vehicle was to move, or places within kJitter for more than kSlowMove. A place
  /// that has gone away for as long as that, and further than kLastDigits, is not one: a vehicle makes little way against a strong current.
  [[nodiscard]] Duration frozen() const;

  /// Whether fixes are taken from another port: from the first that has brought one that is believed, until it has brought none for
  /// kHandover.
  [[nodiscard]] bool belongs_to_another(std::uint8_t port, Time arrival) const;
  /// Of a fix by another port than the one that fixes are taken from: holds it against those. Two honest sources go apart with the way, as
  /// a dead reckoning does from a true fix: what is tolerated between two ports grows with the way since they last agreed within kNoise,
  ///
  ///   tolerated = kNoise + min(kDriftShare * way, kMostNoise)
  ///
  /// and is never more than by what a refused fix of the same port may be off without a doubt: a liar's bound stays what it is.
  void compare(Time arrival, const messages::Navigation& fix);
  void hold(std::uint8_t port, Time arrival);

  /// By how much the newest fix that came late, or by another port, lay further off than a vehicle can have gone from the newest of those
  /// believed, or by then to it: there are two senders, and who is right nobody knows. None once no such fix came for kJumpMemory, or twice
  /// the time between the last two, were they no more than kSlowestSender apart. And by how much the depth of any fix was further from the
  /// newest's than a vehicle can have sunk or risen since, for kJumpMemory.
  [[nodiscard]] Meters dispute(Time now) const;

  /// No date of a fix lies further ahead of its arrival: clocks that are kept by NTP or GNSS differ by less.
  static constexpr Duration kMostAhead = Duration::milliseconds(500);
  /// Of two fixes of one place, made by different ways.
  static constexpr Meters kNoise{25.0};
  /// Fixes are held against one that is at least so old, too, and at the most twice, not counting the time in which somebody contradicts:
  /// against the younger because many fixes of one moment could each lie kNoise further off.
  static constexpr Duration kAnchorAge = Duration::seconds(60);
  static constexpr Duration kYoungAnchorAge = Duration::seconds(3);
  /// No dead reckoning that is put right at the surface jumps further, in one or several jumps within kCorrectionPeriod. Of those before,
  /// kNoise counts as well: a place that goes away by many small jumps goes no further.
  static constexpr Meters kMostCorrection{500.0};
  static constexpr Duration kCorrectionPeriod = Duration::seconds(600);
  /// Fixes that go on from a refused one are believed when they have done so for this long.
  static constexpr Duration kCorrectionPatience = Duration::seconds(3);
  static constexpr Duration kJumpMemory = Duration::seconds(2);
  /// Refused fixes further apart are not one sender's: in that time the vehicle gets to where a stray fix may be.
  static constexpr Duration kSlowestSender = Duration::seconds(30);
  static constexpr double kNoisyShare = 1.0 / 3.0;  ///< of some sixteen fixes
  static constexpr Meters kMostNoise{50.0};
  static constexpr Duration kHandover = Duration::seconds(3);
  /// Of its way, by what a dead reckoning with a Doppler log is off at the most.
  static constexpr double kDriftShare = 0.02;
  /// The way is counted in such strides: noise is none.
  static constexpr Meters kStride{10.0};
  /// Of a receiver's noise; a vehicle that makes more than a tenth of that a second is not still.
  static constexpr Meters kJitter{0.25};
  /// Of positions as a bus rounds them.
  static constexpr Meters kLastDigits{0.05};
  static constexpr Duration kSlowMove = Duration::seconds(3);

 private:
  /// Of a fix, what tells whether another goes on from it.
  struct Mark {
    Time time;
    NorthEast position;
  };
  /// A fix that was believed some time before, or the first.
  struct Anchor {
    Mark old;
    Mark next;
  };
  [[nodiscard]] static Mark mark_of(const messages::Navigation& fix) { return {.time = fix.time, .position = fix.position}; }
  static void move_on(Anchor& anchor, const Mark& fix, Duration age);
  [[nodiscard]] Meters excess(const Mark& from, const Mark& to, Meters noise) const;
  [[nodiscard]] Meters excess(const Mark& fix) const;
  [[nodiscard]] Meters contradiction(const messages::Navigation& dated) const;
  void count_way(NorthEast place);
  void dispute(Time arrival, Meters by);
  void compare_depth(Time arrival, const messages::Navigation& dated);
  struct Correction {
    Time time;
    Meters by;
  };

  [[nodiscard]] bool is_correction(const Mark& fix, Meters jump);
  [[nodiscard]] static bool is_recent(const Correction& correction, Time time) { return time - correction.time <= kCorrectionPeriod; }
  [[nodiscard]] Meters corrected_before(Time time) const;
  void correct(Time time, Meters jump);
  void count(bool is_refused);
  void refuse(Time arrival, const Mark& fix, Meters by);
  void remember_sender(const Mark& fix);
  void believe(Time arrival, const messages::Navigation& fix, bool is_to_move);

  config::VehicleLimits vehicle_;
  Duration timeout_;
  std::optional<messages::Navigation> newest_;
  bool newest_is_correction_ = false;
  Anchor anchor_;
  Anchor young_anchor_;
  std::optional<Mark> refused_;  ///< the newest of those that go on from correction_began_
  Time correction_began_;
  FixedVector<Correction, config::kMaxCorrections> corrections_;  ///< that were believed, those that were recent when the last was
  /// Fixes that were refused, lay more than kMostNoise off and go on from each other, whatever is believed between them.
  std::optional<Mark> other_sender_;  ///< its newest
  std::uint32_t other_senders_fixes_ = 0;
  Duration jump_memory_ = kJumpMemory;
  double refused_share_ = 0.0;  ///< of the fixes, the older the less
  Time jump_seen_;
  Meters jump_;
  Time moved_;         ///< date of the last fix of another place, or after which the vehicle was not told to move
  Time left_;          ///< likewise, of the last that lay further than kJitter from the one before it that did
  NorthEast left_at_;  ///< its place
  Meters away_;        ///< from there, of the newest
  Time came_nearer_;   ///< likewise, date of the last that was nearer to it than the one before, or that fix itself
  Time disputed_;      ///< arrival
  Meters dispute_;
  Duration dispute_memory_ = kJumpMemory;
  NorthEast counted_;    ///< up to where the way is
  Meters way_together_;  ///< since two ports last agreed
  Time depth_disputed_;  ///< arrival
  Meters depth_dispute_;
  Time held_;  ///< arrival of the newest that is believed
  std::uint8_t port_ = 0;
};

}  // namespace earshot::safety
