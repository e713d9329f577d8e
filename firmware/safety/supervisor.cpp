#include "firmware/safety/supervisor.hpp"

#include <algorithm>

#include "firmware/messages/ranges.hpp"
#include "firmware/safety/measures.hpp"

namespace earshot::safety {
namespace {

using config::Condition;
using config::ConditionTraits;
using config::Response;
using config::Rule;

/// Without a set-point it may be for as long as without a fix, but a device may wait for its address.
constexpr Duration kShortestMute = Duration::seconds(10);
/// A leg may take as many times what it takes at search speed before it is no progress.
constexpr double kSlowestShare = 3.0;

bool is_beyond(const Rule& rule, double measure) {
  switch (config::kConditionTraits[static_cast<std::size_t>(rule.condition)].kind) {
    case ConditionTraits::Kind::kAbove:
    case ConditionTraits::Kind::kFlag:
      return measure > rule.limit;
    case ConditionTraits::Kind::kBelow:
      return measure < rule.limit;
  }
  return true;
}

/// Somebody else says something else, or what is said cannot be: who lies, nobody on board can say.
bool is_doubt(Condition condition) {
  return condition == Condition::kNavigationJump || condition == Condition::kNavigationDisputed ||
         condition == Condition::kPlaceUnexplained || condition == Condition::kDepthUnexplained;
}

/// @param way_m  any number: nobody is deeper than an ocean
Duration time_to_come_up(double way_m) {
  const double seconds = std::clamp(way_m, 0.0, messages::kDepth_m.highest) / config::kSlowestAscent.value;
  return Duration::seconds(static_cast<std::int64_t>(seconds));
}

Rule aborting(Condition condition, double limit, Duration persistence = {}) {
  return {.condition = condition, .limit = limit, .persistence = persistence, .response = Response::kAbort, .is_latched = true};
}

Rules standing(const config::Mission& mission) {
  Rules rules;
  const auto add = [&rules](const Rule& rule) { static_cast<void>(rules.push_back(rule)); };  // there is room: kMostOwnRules
  add(aborting(Condition::kNavigationAge, mission.navigation_timeout.to_seconds()));
  add(aborting(Condition::kSnrAge, mission.snr_timeout.to_seconds()));
  add(aborting(Condition::kOutsideHalt, 0.0));
  add(aborting(Condition::kSearchTime, mission.max_time.to_seconds()));
  add(aborting(Condition::kDepth, mission.max_depth.value, kForesight));
  add(aborting(Condition::kNavigationJump, 0.0, kDoubtPersistence));
  add(aborting(Condition::kNavigationFrozen, mission.navigation_timeout.to_seconds()));
  add(aborting(Condition::kNoProgress, kSlowestShare * mission.step_length.value / mission.search_speed.value));
  add(aborting(Condition::kPolicyUnhealthy, 0.0));
  add(aborting(Condition::kNavigationDisputed, 0.0, kDoubtPersistence));
  add(aborting(Condition::kPlaceUnexplained, 0.0, kDoubtPersistence));
  add(aborting(Condition::kDepthUnexplained, 0.0, kDoubtPersistence));
  add(aborting(Condition::kSetpointsUnsent, std::max(mission.navigation_timeout, kShortestMute).to_seconds()));
  if (mission.safety.fence) add({.condition = Condition::kOutsideFence, .limit = 0.0, .persistence = {}, .response = Response::kSteerBack});
  return rules;
}

}  // namespace

std::size_t standing_rules(const config::Mission& mission) {
  return standing(mission).size();
}

Rules rules_of(const config::Mission& mission) {
  Rules rules = standing(mission);
  for (const Rule& rule : mission.safety.rules) static_cast<void>(rules.push_back(rule));
  return rules;
}

void Supervisor::configure(const config::Mission& mission) {
  *this = Supervisor{};
  rules_ = rules_of(mission);
  standing_ = standing_rules(mission);
  for (std::size_t i = 0; i < rules_.size(); ++i) static_cast<void>(watches_.push_back({}));
}

void Supervisor::tighten(const config::Mission& mission) {
  const Rules tighter = standing(mission);
  for (std::size_t i = 0; i < tighter.size(); ++i) {
    if (rules_[i].condition == Condition::kDepth) {
      next_depth_ = tighter[i].limit;
      next_depth_by_.reset();
    } else {
      rules_[i].limit = tighter[i].limit;
    }
  }
}

void Supervisor::take_next_depth(std::size_t rule, double measured, Time now) {
  const bool is_of_every_mission = rule < standing_ && rules_[rule].condition == Condition::kDepth;
  if (!is_of_every_mission || !next_depth_) return;
  const double next = *next_depth_;
  if (!next_depth_by_) next_depth_by_ = now + kTimeToTurnUp + time_to_come_up(measured - next);
  rules_[rule].limit = std::min(rules_[rule].limit, std::max(next, measured + kOvershoot.value));
  if (measured > next && now < *next_depth_by_) return;
  rules_[rule].limit = next;
  next_depth_.reset();
  next_depth_by_.reset();
}

SafetyEvents Supervisor::watch(const config::Mission& mission, const Situation& situation) {
  SafetyEvents events;
  doubt(situation.now);
  for (std::size_t i = 0; i < rules_.size(); ++i) watch(i, mission, situation, events);
  return events;
}

void Supervisor::doubt(Time now) {
  const Duration passed = now - watched_;
  watched_ = now;
  doubt_ = is_doubted_ ? doubt_ + passed : std::max(doubt_ - Duration{passed.us / kForgets}, Duration{});
  is_doubted_ = false;
}

SafetyEvents Supervisor::watch_for_release(const config::Mission& mission, const Situation& situation) {
  SafetyEvents events;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    if (rules_[i].response == Response::kRelease) watch(i, mission, situation, events);
  }
  return events;
}

void Supervisor::watch(std::size_t i, const config::Mission& mission, const Situation& situation, SafetyEvents& events) {
  const Rule& rule = rules_[i];
  Watch& watch = watches_[i];
  const std::optional<double> measured = measure(rule.condition, mission, situation);
  if (measured) {
    watch.measure = *measured;
    take_next_depth(i, *measured, situation.now);
    const bool holds = is_beyond(rule, *measured);
    if (!holds) watch.since.reset();
    if (holds && !watch.since) watch.since = situation.now;
  }
  const bool is_together = i < standing_ && is_doubt(rule.condition);
  if (is_together && watch.since) is_doubted_ = true;
  const bool is_lasting = watch.since && (is_together ? doubt_ : situation.now - *watch.since) >= rule.persistence;
  const bool acts = is_lasting || (watch.acts && rule.is_latched);
  if (acts != watch.acts) {
    static_cast<void>(events.push_back({.time = situation.now,
                                        .rule = static_cast<std::uint8_t>(i),
                                        .condition = rule.condition,
                                        .response = rule.response,
                                        .begins = acts,
                                        .measure = watch.measure,
                                        .limit = rule.limit}));
  }
  watch.acts = acts;
}

std::optional<std::size_t> Supervisor::strongest() const {
  std::optional<std::size_t> strongest;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    if (watches_[i].acts && (!strongest || rules_[i].response > rules_[*strongest].response)) strongest = i;
  }
  return strongest;
}

bool Supervisor::acts_on(Condition condition) const {
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    if (watches_[i].acts && rules_[i].condition == condition) return true;
  }
  return false;
}

std::optional<Response> Supervisor::response() const {
  const std::optional<std::size_t> rule = strongest();
  return rule ? std::optional(rules_[*rule].response) : std::nullopt;
}

std::optional<Condition> Supervisor::cause() const {
  const std::optional<std::size_t> rule = strongest();
  return rule ? std::optional(rules_[*rule].condition) : std::nullopt;
}

}  // namespace earshot::safety
