#pragma once

#include <cstdint>

#include "firmware/authority/command.hpp"
#include "firmware/authority/command_judge.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/random.hpp"
#include "firmware/core/time.hpp"
#include "firmware/detector/bearing_window.hpp"
#include "firmware/detector/snr_window.hpp"
#include "firmware/guidance/fallback.hpp"
#include "firmware/guidance/leg.hpp"
#include "firmware/messages/health.hpp"
#include "firmware/messages/operator_command.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/safety/manoeuvre.hpp"
#include "firmware/safety/situation.hpp"
#include "firmware/safety/supervisor.hpp"

namespace earshot::runtime {

using Acknowledgements = FixedVector<messages::CommandAcknowledgement, config::kMaxAcknowledgements>;

/// All that changes of a mission after configure() but what the belief holds: the Runtime owns it, and keeps it twice.
struct Progress {
  messages::MissionState state = messages::MissionState::kStandby;
  messages::EndReason end_reason = messages::EndReason::kNone;
  std::uint64_t turn = 0;
  std::uint32_t decisions = 0;
  Time decided;  ///< when the last of them was made
  authority::Command command;
  std::uint32_t steps_taken = 0;
  bool is_refining = false;     ///< on the last measurement
  safety::Situation situation;  ///< what navigation, vehicle and autopilot say
  safety::Supervisor supervisor;
  safety::Manoeuvre manoeuvre;
  bool is_interrupted = false;  ///< a rule has taken the vehicle from its search
  detector::SnrWindow snr_window;
  detector::BearingWindow bearings;
  guidance::Leg leg;
  Pcg32 random{0};
  guidance::Fallback fallback;
  messages::Counters counters;
  authority::CommandJudge judge;
  Acknowledgements acknowledgements;
  FixedVector<messages::PortReport, config::kMaxPorts> ports;
  bool is_mute = false;  ///< no port could send the last turn's set-point
};

}  // namespace earshot::runtime
