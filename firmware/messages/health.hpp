#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/config/capacities.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/messages/port_report.hpp"

namespace earshot::messages {

enum class MissionState : std::uint8_t { kStandby = 0, kSearch = 1, kDone = 2, kAbort = 3 };
inline constexpr std::size_t kMissionStates = 4;

enum class EndReason : std::uint8_t {
  kNone = 0,
  kCompleted = 1,    ///< operator said the source is reached
  kStepsUsedUp = 2,  ///< max_steps actions taken
  kOperatorAbort = 3,
  kNavigationStale = 4,
  kSnrStale = 5,
  kLeftOperatingArea = 6,
  kTimeUsedUp = 7,
  kSafetyRule = 8,   ///< another rule of the safety supervisor; its event says which
  kMemoryFault = 9,  ///< a bit flipped in the runtime's memory
  kFound = 10,       ///< the vehicle itself says that it has found the source; its last decision says why
  kOutage = 11,      ///< after an outage of the vehicle's computer the mission could not go on
};

/// Between Earshot and the autopilot.
enum class Authority : std::uint8_t {
  kDisconnected = 0,  ///< the autopilot that the mission waits for is not heard, and nothing is commanded
  kStandby = 1,       ///< nothing is commanded
  kListen = 2,        ///< a search observes and decides, and commands nothing
  kCommand = 3,       ///< set-points leave
  kAbort = 4,         ///< the mission has ended for good; set-points leave (come up) if they did before
};

/// Counters of what was refused; they only grow. At a million a second 64 bits last for half a million years.
struct Counters {
  std::uint64_t navigation_refused = 0;  ///< not finite, older than the last, or dated further from its arrival than its timeout
  std::uint64_t snr_refused = 0;         ///< likewise, or beyond kMostSnr
  std::uint64_t status_refused = 0;      ///< of vehicle, autopilot or hydrophone: older than the last, or dated far from its arrival
  std::uint64_t commands_refused = 0;    ///< acknowledged with another outcome than obeyed or repeated
  std::uint64_t setpoints_limited = 0;   ///< way-points and set-points changed by the safety layer
  std::uint64_t bearings_refused = 0;    ///< an angle that is none, older than the last, or dated far from their arrival
  std::uint64_t bearings_of_others = 0;  ///< by a second sender, while another is listened to
  friend constexpr bool operator==(const Counters&, const Counters&) = default;
};

/// From this score on what is heard is not explained: firmware/policy/ocean_belief judges by it, and so does who reads health alone.
inline constexpr float kMismatchThreshold_bits = 6.75F;

/// State of the runtime and of its ports. It is the heartbeat, too: a turn stamps it last of all, after the safety layer, so that whoever
/// hears it knows that the step that decides has come to its end.
struct Health {
  std::uint64_t turn = 0;       ///< counts the turns, from 1
  std::uint32_t decisions = 0;  ///< made so far in this search
  Authority authority = Authority::kStandby;
  bool is_paused = false;  ///< by an operator
  MissionState state = MissionState::kStandby;
  EndReason end_reason = EndReason::kNone;
  std::uint32_t steps_taken = 0;
  float mismatch_bits = 0.0F;  ///< of the belief after its last measurement; 0 where there is none
  bool is_sweeping = false;    ///< the last decision was the sweep's, for what is heard fits nothing that is believed possible
  bool is_found = false;       ///< with its last measurement the vehicle said that it has found the source
  config::Response response = config::Response::kWarn;  ///< the strongest that acts; kWarn: none but warnings
  Counters counters;
  FixedVector<PortReport, config::kMaxPorts> ports;  ///< the newest of each port that has reported
};

}  // namespace earshot::messages
