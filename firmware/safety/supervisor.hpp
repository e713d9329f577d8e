#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/safety/situation.hpp"

namespace earshot::safety {

using Rules = FixedVector<config::Rule, config::kMaxRules>;
using SafetyEvents = FixedVector<messages::SafetyEvent, config::kMaxRules>;

/// Every rule of a mission: those that no mission can switch off, made of its limits, and then its own.
[[nodiscard]] Rules rules_of(const config::Mission& mission);
/// How many of them no mission can switch off.
[[nodiscard]] std::size_t standing_rules(const config::Mission& mission);

/// A vehicle that is told to come up while it goes down gets no deeper than so much more, and turns up within so long.
inline constexpr Meters kOvershoot{25.0};
inline constexpr Duration kTimeToTurnUp = Duration::seconds(60);

/// So long may what the senses say be doubted, by one of the rules of every mission about it or by several in turn. What was doubted is
/// forgotten, but in no less than kForgets times the time: who pauses before a rule acts, or lies in another way, gains nothing.
inline constexpr Duration kDoubtPersistence = Duration::seconds(10);
inline constexpr int kForgets = 2;

/// Watches a search by its mission's rules. It knows nothing of the policy: what it says depends on the situation alone.
class Supervisor {
 public:
  /// Of a mission that config::check accepts. Forgets what it saw.
  void configure(const config::Mission& mission);

  /// In the midst of a mission whose limits have become tighter: what each rule watches it goes on watching. A vehicle that is deeper than
  /// its new limit is on its way up: until it has come there, or has had the time to (kSlowestAscent and kTimeToTurnUp), it may go no
  /// deeper than it is and kOvershoot below; then the new limit holds.
  void tighten(const config::Mission& mission);

  /// Once a turn of a search, in the order of time. A measure that nobody knows leaves its rule as it is: what was last known of it counts
  /// until something else is.
  /// @return the rules that begin to act or no longer do, in this turn
  [[nodiscard]] SafetyEvents watch(const config::Mission& mission, const Situation& situation);

  /// In place of it once a turn when the mission has ended: only rules that release the weight are watched, all others stay as they are.
  [[nodiscard]] SafetyEvents watch_for_release(const config::Mission& mission, const Situation& situation);

  /// What the strongest rule that acts wants; nothing when none does.
  [[nodiscard]] std::optional<config::Response> response() const;
  /// What the rule watches that wants it; of several rules the first.
  [[nodiscard]] std::optional<config::Condition> cause() const;
  /// Whether a rule about `condition` acts.
  [[nodiscard]] bool acts_on(config::Condition condition) const;

 private:
  struct Watch {
    std::optional<Time> since;  ///< its condition has been beyond its limit
    double measure = 0.0;       ///< the last that was known
    bool acts = false;
  };

  [[nodiscard]] std::optional<std::size_t> strongest() const;
  void doubt(Time now);
  void watch(std::size_t rule, const config::Mission& mission, const Situation& situation, SafetyEvents& events);
  void take_next_depth(std::size_t rule, double measured, Time now);

  Rules rules_;
  std::size_t standing_ = 0;  ///< so many of them are of every mission
  FixedVector<Watch, config::kMaxRules> watches_;
  Time watched_;             ///< the last turn
  bool is_doubted_ = false;  ///< in that turn
  Duration doubt_;           ///< for so long what the senses say was doubted, less a share, by kForgets, of the time in which it was not
  std::optional<double> next_depth_;   ///< is the limit of the depth of every mission once the vehicle is within it
  std::optional<Time> next_depth_by_;  ///< or at this time
};

}  // namespace earshot::safety
