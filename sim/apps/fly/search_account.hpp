#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "firmware/core/units.hpp"
#include "firmware/messages/safety_event.hpp"
#include "sim/link/messages.hpp"

namespace earshot::fly {

/// What a vehicle reported of its search while it flew: its model-mismatch score, whether it swept the area, whether it declared the
/// source found, and whether a rule sent it home.
class SearchAccount {
 public:
  /// @param range  from the vehicle to the source, which the vehicle does not know
  void note(const link::Answer& answer, Meters range);
  /// The keys of summary.json. A score is null where the policy holds no belief, a step where it did not come to that; `went_home` is
  /// there where a rule sent the vehicle home or up.
  [[nodiscard]] nlohmann::ordered_json to_json() const;

 private:
  struct Declaration {
    std::uint32_t step = 0;
    Meters range;
  };
  bool believes_ = false;
  float mismatch_bits_ = 0.0F;
  std::optional<std::uint32_t> mismatch_step_;
  std::optional<std::uint32_t> sweep_step_;
  std::optional<Declaration> declaration_;        ///< the first
  std::optional<messages::SafetyEvent> home_by_;  ///< the first rule that sent the vehicle home or up
  std::uint32_t home_step_ = 0;                   ///< when it had taken so many
};

/// The rule that ended a flight: in words ("what"), its place among the mission's rules from 1, condition, value, limit and response. Null:
/// none did.
[[nodiscard]] nlohmann::ordered_json ending_rule_to_json(const std::optional<messages::SafetyEvent>& rule);

/// A line of the console under its label, of at most 100 columns; what is longer goes on below.
[[nodiscard]] std::string entry(const std::string& label, const std::string& sentence);

/// What the vehicle reported of its battery and of its search, and what it heard, in such lines; a summary of an earlier version knows
/// nothing of it.
[[nodiscard]] std::string account_lines(const nlohmann::json& summary);

}  // namespace earshot::fly
