#pragma once

#include "firmware/messages/dictionary/words.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::messages {

template <>
struct WordsOf<MissionState> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<MissionState>::name;
  static constexpr auto kTable = std::to_array<Word<MissionState>>({
      {MissionState::kStandby, "standby", "STANDBY", "STANDBY"},
      {MissionState::kSearch, "search", "SEARCH", "SEARCH"},
      {MissionState::kDone, "done", "DONE", "DONE"},
      {MissionState::kAbort, "abort", "ABORT", "ABORT"},
  });
};

template <>
struct WordsOf<EndReason> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<EndReason>::words;
  static constexpr auto kTable = std::to_array<Word<EndReason>>({
      {EndReason::kNone, "under_way", "under way", "under way"},
      {EndReason::kCompleted, "completed", "completed", "completed, the source is reached"},
      {EndReason::kStepsUsedUp, "steps_used_up", "steps used up", "all steps are taken"},
      {EndReason::kOperatorAbort, "operator_abort", "operator abort", "an operator aborted it"},
      {EndReason::kNavigationStale, "navigation_stale", "navigation stale", "navigation went silent"},
      {EndReason::kSnrStale, "snr_stale", "SNR stale", "the SNR estimate went silent"},
      {EndReason::kLeftOperatingArea, "left_operating_area", "left operating area", "the vehicle left its operating area"},
      {EndReason::kTimeUsedUp, "time_used_up", "time used up", "its time is used up"},
      {EndReason::kSafetyRule, "safety_rule", "safety rule", "a safety rule ended it"},
      {EndReason::kMemoryFault, "memory_fault", "memory fault", "the computer's memory is at fault"},
      {EndReason::kFound, "found", "declared found", "the vehicle declared the source found"},
      {EndReason::kOutage, "outage", "outage", "it could not go on after an outage"},
  });
};

template <>
struct WordsOf<Authority> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kInRecords = &Word<Authority>::name;
  static constexpr auto kTable = std::to_array<Word<Authority>>({
      {Authority::kDisconnected, "disconnected", "DISCONNECTED", "DISCONNECTED"},
      {Authority::kStandby, "standby", "STANDBY", "STANDBY"},
      {Authority::kListen, "listen", "LISTEN", "LISTEN"},
      {Authority::kCommand, "command", "COMMAND", "COMMAND"},
      {Authority::kAbort, "abort", "ABORT", "ABORT"},
  });
};

}  // namespace earshot::messages
