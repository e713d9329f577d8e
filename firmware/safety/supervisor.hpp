#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/safety/situation.hpp"

namespace earshot::safety {

using Rules = FixedVector<config::Rule, config::kMaxRules>;
using SafetyEvents = FixedVector<messages::SafetyEvent, config::kMaxRules>;

/// Every rule of a mission: those that no mission can switch off, made of its limits, and then its own.
[[nodiscard]] Rules rules_of(const config::Mission& mission);
/// How many of them no mission can switch off.
[[nodiscard]] std::size_t standing_rules(const config::Mission& mission);

/// Watches a search by its mission's rules. It knows nothing of the policy: what it says depends on the situation alone.
class Supervisor {
 public:
  /// Of a mission that config::check accepts. Forgets what it saw.
  void configure(const config::Mission& mission);

  /// In the midst of a mission whose limits have become tighter: what each rule watches it goes on watching. A vehicle that is deeper than
  /// its new limit is on its way up: that limit holds from when it has come there, and until then the old one.
  void tighten(const config::Mission& mission);

  /// Once a turn of a search, in the order of time.
  /// @return the rules that begin to act or no longer do, in this turn
  [[nodiscard]] SafetyEvents watch(const config::Mission& mission, const Situation& situation);

  /// What the strongest rule that acts wants; nothing when none does.
  [[nodiscard]] std::optional<config::Response> response() const;
  /// What the rule watches that wants it; of several rules the first.
  [[nodiscard]] std::optional<config::Condition> cause() const;
  /// Whether a rule about `condition` acts.
  [[nodiscard]] bool acts_on(config::Condition condition) const;

 private:
  struct Watch {
    std::optional<Time> since;         ///< its condition has been beyond its limit
    std::optional<double> next_limit;  ///< is the rule's once the measure is within it
    bool acts = false;
  };

  [[nodiscard]] std::optional<std::size_t> strongest() const;
  void take_next_limit(std::size_t rule, std::optional<double> measured);

  Rules rules_;
  FixedVector<Watch, config::kMaxRules> watches_;
};

}  // namespace earshot::safety
