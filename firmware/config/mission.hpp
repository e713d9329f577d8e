#pragma once

#include <cstdint>

#include "firmware/config/authority.hpp"
#include "firmware/config/listening_window.hpp"
#include "firmware/config/safety.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::config {

/// What the vehicle is asked to do and the limits it must keep. Plain data: read from a file on Linux, a constant on bare metal.
///
/// A new limit is a field here, its check in mission.cpp, its key in firmware/host/mission/mission_file.cpp, and a line in
/// firmware/messages/dictionary/mission_fields.hpp, without which nothing compiles: the journal keeps the mission as that message, and a
/// replay without it would be one of another mission.
struct Mission {
  Rectangle operating_area;       ///< the search domain; leaving it ends the mission (ABORT)
  Meters edge_margin;             ///< no way-point nearer to the edge than this, >= 0
  Meters search_depth;            ///< depth set-point, > 0, positive down
  Meters max_depth;               ///< the safety layer never lets a depth set-point exceed it
  MetersPerSecond search_speed;   ///< speed set-point through the water, > 0
  Meters step_length;             ///< l: length of one action, > 0
  std::uint32_t max_steps = 100;  ///< N: the mission is DONE after this many actions
  bool ends_when_found = false;   ///< the mission is DONE when the vehicle itself says that it has found the source
  Duration max_time;              ///< ABORT when SEARCH lasts longer
  Duration navigation_timeout;    ///< ABORT when navigation is older
  Duration snr_timeout;           ///< ABORT when the SNR estimate is older
  Decibels detection_threshold;   ///< DT: SNR at or above it is a detection
  Hertz source_frequency{20.0};   ///< of what is searched for, > 0; ocean tables are of one frequency
  /// The window of measurements that an observation takes on its leg.
  ListeningWindow listening = {};
  Safety safety = {};  ///< fence, vehicle, rules of the safety supervisor
  Authority authority = {};
  std::uint64_t action_seed = 1;  ///< seeds the generator of a policy that samples its actions
  friend constexpr bool operator==(const Mission&, const Mission&) = default;
};

/// The operating area less its margins is at least this many step lengths wide and high, so that the safety layer always finds a leg of
/// half a step length or more (see safety::safe_waypoint).
inline constexpr double kShortestSideInSteps = 2.0;

/// kOutOfRange when a limit of the mission is not finite, not positive where it must be, or contradicts another: depth beyond max_depth, or
/// an area with no room to search between its margins.
[[nodiscard]] Status check(const Mission& mission);

}  // namespace earshot::config
