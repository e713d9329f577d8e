#pragma once

#include <cstdint>

#include "firmware/config/safety.hpp"
#include "firmware/core/time.hpp"

namespace earshot::messages {

/// A rule of the safety supervisor begins to act, or no longer acts: the evidence for what the vehicle does.
struct SafetyEvent {
  Time time;
  std::uint8_t rule = 0;  ///< its place among the mission's rules (safety::rules_of), from 0; words count from 1
  config::Condition condition = config::Condition::kNavigationAge;
  config::Response response = config::Response::kWarn;
  bool begins = true;
  double measure = 0.0;  ///< of the condition, in its unit; 1 of one that is only true or false
  double limit = 0.0;
  friend constexpr bool operator==(const SafetyEvent&, const SafetyEvent&) = default;
};

}  // namespace earshot::messages
