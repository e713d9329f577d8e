#pragma once

#include <string_view>

#include "firmware/messages/dictionary/mission_words.hpp"

namespace earshot::messages {

/// Whether it is known how many steps a mission that ended so has taken: what brings a vehicle up after an outage knows only the safety
/// record.
[[nodiscard]] constexpr bool counts_steps(EndReason reason) {
  return reason != EndReason::kOutage;
}

// What there is to say of a search besides its state and its end (dictionary/mission_words.hpp).
inline constexpr std::string_view kSaysFound = "says that the source is found";
inline constexpr std::string_view kIsSurprised = "is surprised: what it hears is unlikely in every ocean of its tables";
inline constexpr std::string_view kSweeps = "sweeps the area: what it hears fits no ocean of its tables";
/// Of a sweep in a search that nothing has surprised (kSurprising_bits): there is no other reason for one.
inline constexpr std::string_view kSweepsInSilence = "sweeps the area: it has heard nothing for long, where its tables say that it should";

}  // namespace earshot::messages
