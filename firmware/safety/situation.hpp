#pragma once

#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/messages/autopilot_status.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/messages/vehicle_status.hpp"
#include "firmware/safety/depth_estimate.hpp"
#include "firmware/safety/navigation_judge.hpp"
#include "firmware/safety/place_estimate.hpp"
#include "firmware/safety/standing_alarm.hpp"
#include "firmware/safety/track.hpp"

namespace earshot::safety {

/// All that the rules look at, in one turn of a search.
struct Situation {
  Time now;
  Time search_began;
  Time snr;                            ///< date of the newest measurement
  std::optional<Time> operator_heard;  ///< arrival of the newest command
  NavigationJudge navigation;
  Track track;
  DepthEstimate depth;
  PlaceEstimate place;
  std::optional<Time> mute_since;                  ///< since when no set-point could be sent
  std::optional<messages::VehicleStatus> vehicle;  ///< the newest; of its alarms those that stand, whoever told them
  StandingAlarm leak;
  StandingAlarm ground_fault;
  std::optional<messages::AutopilotStatus> autopilot;
  std::optional<messages::HydrophoneStatus> hydrophone;
  std::optional<messages::Setpoint> commanded;  ///< the last set-point
  bool goes_round = false;                      ///< that set-point is a quarter of a turn ahead of the vehicle, and turns on with it
  bool is_policy_unhealthy = false;
  bool is_steered_back = false;  ///< the fence has it: it is not free again before it is inside

  /// For how long no fix has told of a movement, the newest's age and the time for which fixes said one place.
  /// @pre there is a fix
  [[nodiscard]] Duration unseen() const { return now - navigation.newest()->time + navigation.frozen(); }
};

}  // namespace earshot::safety
