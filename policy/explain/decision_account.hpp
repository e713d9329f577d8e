#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/policy/frozen_policy.hpp"
#include "policy/explain/baseline.hpp"
#include "policy/explain/believed_place.hpp"
#include "policy/explain/integrated_gradients.hpp"
#include "policy/explain/recorded_decision.hpp"
#include "policy/explain/wording.hpp"

namespace earshot::explain {

/// One thing the vehicle could have done.
struct ActionAccount {
  std::string name;  ///< of the direction
  double probability = 0.0;
  NorthEast end;                               ///< of its step, in the mission's plane
  ExpectedHearing hear;                        ///< at its end
  double detected = 0.0;                       ///< probability of a detection at its end
  double found = 0.0;                          ///< probability that its end lies within a step length of the source
  double found_soon = 0.0;                     ///< probability that the source is found within policy::kFindSteps steps, this one first
  Meters approach;                             ///< expected decrease of the distance to the source
  double border = 0.0;                         ///< how deep its end lies in the border: 0 inside, 1 at the edge, more beyond
  std::optional<double> worth = std::nullopt;  ///< 1 the best, 0 the worst, of a policy that goes by its belief's advice alone

  /// policy::ActionValues::regret, in steps without a detection. A policy without a network takes the direction with the least.
  [[nodiscard]] std::optional<double> regret_steps() const {
    constexpr double kLeastWorth = 1e-9;
    return worth ? std::optional(1.0 / std::max(*worth, kLeastWorth) - 1.0) : std::nullopt;
  }
};

/// One element of what the policy saw.
struct ObservedAccount {
  Subject subject = Subject::kPlace;
  std::string name;
  std::string value;
  std::string baseline;
  double part = 0.0;  ///< of the change of the taken action's log-probability, nats
};

/// One of the explanations that the belief holds for what was heard.
struct HypothesisAccount {
  std::string ocean;           ///< name of its table
  double level_db = 0.0;       ///< the source is that much louder than expected
  double spread_db = 0.0;      ///< standard deviation of what is measured
  double silence_share = 0.0;  ///< of the measurements that meet a pause in the call
  bool is_moving = false;      ///< the source, or a current that navigation does not see
  double share = 0.0;          ///< its probability
};

/// Everything about one decision.
struct DecisionAccount {
  RecordedDecision decision;
  Decibels detection_threshold;
  Rectangle area;                     ///< in the mission's plane
  bool belief_is_the_policys = true;  ///< false: an observer's; the policy has none
  bool uses_measurements = true;      ///< false: the policy goes by place and steps alone
  BelievedPlace place;
  std::vector<HypothesisAccount> hypotheses;  ///< of 1 % and more, the likeliest first
  std::vector<ActionAccount> actions;
  std::size_t likeliest_action = 0;
  double most_regret_steps = 0.0;                         ///< no regret counts for more
  policy::ActionDraw draw = policy::ActionDraw::kArgmax;  ///< whether the policy takes its likeliest action, or draws by its probabilities
  Baseline baseline = Baseline::kCentre;
  Attribution attribution;
  std::vector<ObservedAccount> observed;  ///< in the order of the observation
};

/// What explaining needs beside the decisions themselves.
struct Circumstances {
  const policy::FrozenPolicy& policy;
  const policy::BeliefModel& belief;
  const policy::OceanTables& tables;  ///< by which the vehicle searched
  bool belief_is_the_policys = true;
  NorthEast south_west;  ///< corner of the operating area
  Baseline baseline = Baseline::kCentre;
};

/// Explains the last of these decisions.
/// @param decisions  from step 0 on without a gap, at least one; replayed with remembered_at
[[nodiscard]] DecisionAccount account_of(const Circumstances& circumstances, std::span<const RecordedDecision> decisions);

/// Explains a decision by the belief that the vehicle took it with.
[[nodiscard]] DecisionAccount account_of(const Circumstances& circumstances, const RecordedDecision& decision,
                                         const policy::OceanBelief& belief);

/// The observed elements that moved the choice most, for or against, first.
[[nodiscard]] std::vector<ObservedAccount> weightiest(const DecisionAccount& account, std::size_t count);

}  // namespace earshot::explain
