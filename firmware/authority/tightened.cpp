#include "firmware/authority/tightened.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "firmware/safety/check.hpp"

namespace earshot::authority {
namespace {

/// What is not said is no reason to refuse it.
template <class Limit>
bool is_tighter(const std::optional<Limit>& limit, Limit than) {
  return !limit || (*limit > Limit{0.0} && *limit <= than);
}

/// A rule of the mission's own that the new limit forestalls does no harm.
bool can_be_flown(const config::Mission& mission) {
  if (config::check(mission) != Status::kOk) return false;
  const safety::SafetyFault fault = safety::check(mission).fault;
  return fault == safety::SafetyFault::kNone || fault == safety::SafetyFault::kRuleNeverActs;
}

/// As far from its limit as before, by share; and no nearer than before, or than 5 m: a depth control that comes to rest at the limit
/// itself would be beyond it again and again.
Meters search_depth_within(Meters max_depth, const config::Mission& mission) {
  constexpr Meters kRoom{5.0};
  const Meters room = std::min({kRoom, mission.max_depth - mission.search_depth, max_depth * 0.5});
  return std::min(mission.search_depth * (max_depth / mission.max_depth), max_depth - room);
}

/// Of a duration that is shorter than another: it fits.
Duration of_seconds(double seconds) {
  return {static_cast<std::int64_t>(seconds * 1e6)};
}

/// All of a mission that an operator's limits change.
struct Limited {
  Meters max_depth;
  Meters search_depth;
  MetersPerSecond search_speed;
  Duration max_time;
};

Limited limited(const config::Mission& mission) {
  return {.max_depth = mission.max_depth,
          .search_depth = mission.search_depth,
          .search_speed = mission.search_speed,
          .max_time = mission.max_time};
}

void put(const Limited& limited, config::Mission& mission) {
  mission.max_depth = limited.max_depth;
  mission.search_depth = limited.search_depth;
  mission.search_speed = limited.search_speed;
  mission.max_time = limited.max_time;
}

}  // namespace

Status tighten(config::Mission& mission, const messages::OperatorLimits& limits) {
  const bool are_tighter = is_tighter(limits.max_depth, mission.max_depth) && is_tighter(limits.max_speed, mission.search_speed) &&
                           is_tighter(limits.max_time_s, mission.max_time.to_seconds());
  if (limits == messages::OperatorLimits{} || !are_tighter) return Status::kOutOfRange;
  const Limited before = limited(mission);
  Limited tighter = before;
  if (limits.max_depth) tighter.max_depth = *limits.max_depth;
  if (limits.max_speed) tighter.search_speed = *limits.max_speed;
  if (limits.max_time_s) tighter.max_time = of_seconds(*limits.max_time_s);
  tighter.search_depth = search_depth_within(tighter.max_depth, mission);
  put(tighter, mission);
  if (can_be_flown(mission)) return Status::kOk;
  put(before, mission);
  return Status::kOutOfRange;
}

}  // namespace earshot::authority
