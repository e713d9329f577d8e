#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/messages/safety_event.hpp"
#include "sim/apps/fly/autopilot_bus.hpp"
#include "sim/apps/fly/flight_record.hpp"
#include "sim/apps/fly/hearing/sound.hpp"
#include "sim/apps/fly/search_account.hpp"
#include "sim/link/simulator_end.hpp"
#include "sim/search/scenario/surroundings.hpp"
#include "sim/vehicle/battery.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::fly {

/// With a runtime's answer: a step takes microseconds, and one that is dead is known after link::kLeaseSeconds.
inline constexpr std::chrono::milliseconds kAnswerPatience{4000};

/// What a flight goes through, and how.
struct FlightSetup {
  const search::World& world;  ///< what is heard, and its conditions
  NorthEast source;            ///< where it is at the start
  Meters found_within;         ///< l: the source is reached at this range
  bool may_be_found = true;    ///< false: fly on to the last step even so (benchmarks)
  vehicle::Limits vehicle;
  std::optional<vehicle::Battery> battery{};  ///< as the flight begins; none: the vehicle tells no status
  Duration tick = search::kMeasurementInterval;
  std::uint64_t seed = 1;  ///< of what the conditions draw
  std::chrono::milliseconds answer_patience = kAnswerPatience;
  std::chrono::seconds wait_for_runtime{0};  ///< for the return of a runtime that is lost; 0: the flight ends then
  double speed = 0.0;                        ///< simulated seconds per second; 0: as fast as it goes
};

struct FlightResult {
  bool found = false;
  std::string end_reason;                            ///< one word of summary.json
  std::optional<messages::SafetyEvent> ending_rule;  ///< of the safety supervisor, that ended it
  std::string failure;                               ///< what went wrong, in words; empty when nothing did
  Time last_tick;
  double wall_time_s = 0.0;  ///< from the first tick to the last answer
  vehicle::State end;
  std::optional<vehicle::Battery> battery;  ///< at the end
  Time search_began;                        ///< when START was said
  SearchAccount account;                    ///< of what the vehicle said while it searched
  std::unique_ptr<Sound> sound;             ///< of a flight that hears
};

/// Everything that one flight needs; all must outlive it.
struct Flight {
  const FlightSetup& setup;
  AutopilotBus& bus;
  link::SimulatorEnd& link;
  TrackFile& track;
  Score& score;
  const SoundSetup* sound = nullptr;  ///< what the vehicle hears; none: it is told the modelled SNR
};

/// Flies from `start` to the end of the mission. The clock advances only when the runtime has answered a tick and the set-points it
/// announced have arrived. A vehicle that hears is told to START as soon as its detector knows the noise of the sea and has given a
/// measurement; until then it does what `start` says. The source is looked for at every tick, not only at the end of a step: a vehicle that
/// passes within l of it on its way has found it. Shows on a terminal how far it is. Never throws: whatever goes wrong on the way ends the
/// flight, and the result says what.
/// @param stop  set by a signal handler: the runtime is told to abort
[[nodiscard]] FlightResult fly_in_lock_step(Flight flight, const vehicle::State& start, const std::atomic<bool>& stop);

}  // namespace earshot::fly
