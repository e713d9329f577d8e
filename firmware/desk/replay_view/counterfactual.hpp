#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/config/mission.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/desk/replay_view/field_difference.hpp"
#include "firmware/messages/decision.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/safety_event.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::replay_view {

/// What is to be flown: a journal's own, or another.
struct Plan {
  config::Mission mission;
  std::unique_ptr<policy::FrozenPolicy> policy;
  std::unique_ptr<policy::OceanTables> tables;  ///< without an ocean where the policy needs none
};

/// What a journal's flight was flown with. @throws host::BadInput when the journal does not begin with it.
[[nodiscard]] Plan plan_of(const std::filesystem::path& journal);

/// How a mission stood at the end of its journal, and since when.
struct Standing {
  Time since;
  messages::Health health;
  std::optional<messages::SafetyEvent> rule{};  ///< that ended it; nothing: none did
};

/// A journal's inputs given to a runtime of another plan. What it decides is what a vehicle of that plan would have decided as long as it
/// would have gone where the journal's went; from the first difference of what steers on, the inputs are still the journal's vehicle's.
struct Counterfactual {
  Time began;  ///< of the journal
  std::vector<messages::Decision> then;
  std::vector<messages::Decision> now;
  std::vector<NorthEast> track;  ///< of the journal's vehicle, thinned, by the fixes that the runtime believed
  /// The first turn whose set-point is not the same: when, and in which fields.
  struct Steering {
    Time time;
    std::vector<FieldDifference> fields;
    std::vector<messages::SafetyEvent> rules{};  ///< that begin to steer in that turn, now
  };
  std::optional<Steering> steering;
  Standing then_ended;
  Standing now_ended;
  std::optional<std::uint32_t> gap;  ///< the first record that is missing: it ends there
};

/// @param progress  called now and then with how much of the file is done, 0 to 1
/// @throws host::BadInput when the journal cannot be read, or `plan` not be flown.
[[nodiscard]] Counterfactual fly_again(const std::filesystem::path& journal, const Plan& plan,
                                       const std::function<void(double fraction)>& progress);

}  // namespace earshot::replay_view
