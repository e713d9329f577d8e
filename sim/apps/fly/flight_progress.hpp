#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/belief/reception.hpp"

namespace earshot::fly {

/// How far a flight is.
struct FlightProgress {
  Duration at_sea;
  std::uint32_t steps_taken = 0;
  std::uint32_t max_steps = 0;
  policy::Reception reception;
  bool is_learning_noise = false;        ///< the vehicle does not know the noise of the sea yet, and has not started
  std::optional<Meters> believed_range;  ///< from the vehicle to where the policy believes the source; none when it holds no belief
};

/// For the person who watches: "1 h 12 min at sea, step 9 of 100, SNR 14.2 dB, source believed 6.3 km away". The step is the one under way.
/// "65 s at sea, learning the noise of the sea before the search begins"
[[nodiscard]] std::string to_string(const FlightProgress& progress);

}  // namespace earshot::fly
