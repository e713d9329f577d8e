#pragma once

#include <string_view>

#include "firmware/messages/dictionary/mission_words.hpp"

namespace earshot::messages {

/// Whether it is known how many steps a mission that ended so has taken: what brings a vehicle up after an outage knows only the safety
/// record.
[[nodiscard]] constexpr bool counts_steps(EndReason reason) {
  return reason != EndReason::kOutage;
}

// What there is to report of a search besides its state and its end (mission_words.hpp).
inline constexpr std::string_view kDeclaresFound = "declares the source found";
inline constexpr std::string_view kIsMismatched = "model mismatch: the measured SNR is unlikely in every ocean of its tables";
inline constexpr std::string_view kSweeps = "sweeps the area: the measured SNR fits no ocean of its tables";
/// Of a sweep in a search without a mismatch (kMismatchThreshold_bits): there is no other reason for one.
inline constexpr std::string_view kSweepsInSilence = "sweeps the area: nothing was detected for long, where its tables predict detections";

/// What else there is to say about a state that has not ended; mostly nothing. A mismatch is reported apart.
[[nodiscard]] constexpr std::string_view remark_on(const Health& health, bool was_mismatched) {
  if (health.end_reason != EndReason::kNone) return {};
  if (health.authority == Authority::kDisconnected) return "the autopilot is not heard";
  if (health.authority == Authority::kListen) return "listening: it commands nothing";
  if (health.is_paused) return "paused by an operator";
  if (health.is_found) return kDeclaresFound;
  if (health.is_sweeping) return was_mismatched ? kSweeps : kSweepsInSilence;
  return {};
}

}  // namespace earshot::messages
