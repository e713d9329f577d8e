#pragma once

#include <string_view>
#include "firmware/messages/health.hpp"

namespace earshot::messages {

/// "SEARCH"
[[nodiscard]] constexpr const char* to_string(MissionState state) {
  switch (state) {
    case MissionState::kStandby:
      return "STANDBY";
    case MissionState::kSearch:
      return "SEARCH";
    case MissionState::kDone:
      return "DONE";
    case MissionState::kAbort:
      return "ABORT";
  }
  return "?";
}

/// Why a mission ended: "an operator aborted it".
[[nodiscard]] constexpr const char* to_string(EndReason reason) {
  switch (reason) {
    case EndReason::kNone:
      return "not over";
    case EndReason::kCompleted:
      return "the source is reached";
    case EndReason::kStepsUsedUp:
      return "all steps are taken";
    case EndReason::kOperatorAbort:
      return "an operator aborted it";
    case EndReason::kNavigationStale:
      return "navigation went silent";
    case EndReason::kSnrStale:
      return "the SNR estimate went silent";
    case EndReason::kLeftOperatingArea:
      return "the vehicle left its operating area";
    case EndReason::kTimeUsedUp:
      return "its time is used up";
    case EndReason::kSafetyRule:
      return "a safety rule ended it";
    case EndReason::kFound:
      return "the vehicle declared the source found";
    case EndReason::kMemoryFault:
      return "the computer's memory is at fault";
    case EndReason::kOutage:
      return "it could not go on after an outage";
  }
  return "?";
}

/// Whether it is known how many steps a mission that ended so has taken: what brings a vehicle up after an outage knows only the safety
/// record.
[[nodiscard]] constexpr bool counts_steps(EndReason reason) {
  return reason != EndReason::kOutage;
}

// What else there is to say of a search.
inline constexpr std::string_view kSaysFound = "declares the source found";
inline constexpr std::string_view kIsSurprised = "model mismatch: the measured SNR is unlikely in every ocean of its tables";
inline constexpr std::string_view kSweeps = "sweeps the area: the measured SNR fits no ocean of its tables";
/// Of a sweep in a search that nothing has surprised (kSurprising_bits): there is no other reason for one.
inline constexpr std::string_view kSweepsInSilence = "sweeps the area: nothing was detected for long, where its tables predict detections";

}  // namespace earshot::messages
