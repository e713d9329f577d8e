#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"

namespace earshot::hil {

/// What a case of the bench does to a mission.
enum class Fault : std::uint8_t {
  // Of frames on the bus (FrameFault), in this order.
  kLoss,
  kDelay,
  kJitter,
  kDuplication,
  kCorruption,
  kNotAvailable,
  kTruncation,
  kWrongLength,
  kReplay,
  kReordering,
  kDateError,
  // Of who is on the bus.
  kFlood,              ///< frames of the highest priority that mean nothing; over LCM: messages of a channel that nobody has
  kNavigationFlood,    ///< fixes of which every number is drawn
  kSecondNavigation,   ///< another inertial navigation, which believes that it is elsewhere
  kWalkingNavigation,  ///< one that believes itself to be carried away from where the vehicle is
  kPausingNavigation,  ///< likewise, and silent for four of ten seconds
  kSecondAutopilot,    ///< another autopilot, which follows no set-point
  kAddressThief,       ///< a device with more rights that claims Earshot's address
  kStrangersOrder,     ///< a COMPLETE that is long out of date, given again and again
  kUnknownOrder,       ///< one that there is none of, again and again
  kCutAbort,           ///< an ABORT that ends behind what is ordered, once a second
  kRecordedOrder,      ///< a PAUSE with the vehicle's key and for no start of it, as a recording has it, once a second
  kInterfaceDown,      ///< the computer's CAN interface
  // Of the controller and the wire (SeaEquipment).
  kErrorPassive,  ///< the computer's CAN controller counts many errors
  kBusOff,        ///< it leaves the bus; when it is over, the interface is taken down and up
  kNetem,         ///< what the kernel does to what is sent on the bus, as tc-netem(8) has it
  // Of the vehicle and its instruments (Disturbance).
  kRudderStuck,
  kPlanesStuck,
  kNoThrust,
  kDisengaged,
  kObstinate,
  kSteerageWay,  ///< it needs so much speed to change its depth
  kCurrent,
  kBattery,
  kLeak,
  kGroundFault,
  kFloorRise,
  kFrozen,
  kPositionError,
  kHeadingError,
  kDepthError,
  kSpeedError,
  kPositionDrift,   ///< the place goes away from the truth
  kPositionShiver,  ///< it stands still, but for a shiver
  kDepthDrift,
  kDepthStuck,  ///< it says one depth, whatever is true
  kDeaf,
  kGainError,
  // Of a hydrophone whose samples come over LCM (SoundFault).
  kSoundDropout,
  kSoundGain,
  kSoundOpen,
  kSoundShorted,
  // Of the computer.
  kKill,      ///< SIGKILL; it is started again with --resume, at sea when its time is over
  kPowerCut,  ///< likewise, and the last bytes of its journal never came to the disk
  kPause,     ///< SIGSTOP, and SIGCONT later
  kStop,      ///< SIGTERM
  kFullDisk,  ///< the journal may not grow beyond so many bytes
  kSlowDisk,  ///< every call of the journal's takes a second
  kReadOnlyDisk,
  kNoRoom,      ///< the interface takes no more than so many frames a second, and the kernel refuses the others
  kWallClock,   ///< is so much ahead from then on
  kFlippedBit,  ///< in the middle of the journal
  kFileGone,    ///< one that earshotd reads when it is started
  kBusTaken,    ///< by another program, that flies on it
  kOrder,       ///< somebody gives it, in time
};
inline constexpr std::size_t kFaults = 65;
inline constexpr std::size_t kFrameFaults = 11;  ///< the first of them

/// On which buses there is such a fault.
enum class FaultBus : std::uint8_t { kEither, kCan, kLcm };

/// How a case with such a fault can be flown.
enum class FaultFlight : std::uint8_t { kLockStep, kAtSea, kEither };

/// The number that says how much of it there is, and where there is any.
struct FaultTraits {
  std::string_view word;    ///< in files
  std::string_view amount;  ///< key of the number, its end the unit; empty: there is none
  double lowest = 0.0;
  double highest = 0.0;
  FaultBus bus = FaultBus::kEither;
  FaultFlight flight = FaultFlight::kLockStep;
};

/// In the order of Fault.
inline constexpr std::array<FaultTraits, kFaults> kFaultTraits{{
    {"loss", ""},
    {"delay", "seconds", 0.1, 600.0},
    {"jitter", "seconds", 0.1, 600.0},
    {"duplication", ""},
    {"corruption", ""},
    {"not_available", ""},
    {"truncation", ""},
    {"wrong_length", "", 0.0, 0.0, FaultBus::kCan},
    {"replay", "seconds", 0.1, 3600.0},
    {"reordering", "", 0.0, 0.0, FaultBus::kLcm},
    {"date_error", "seconds", -1e6, 1e6, FaultBus::kLcm},
    {"flood", "frames_per_s", 1.0, 20'000.0},
    {"navigation_flood", "messages_per_s", 1.0, 3.0, FaultBus::kLcm},
    {"second_navigation", "metres_off", 0.0, 1e6},
    {"walking_navigation", "mps", 0.0, 100.0, FaultBus::kLcm},
    {"pausing_navigation", "mps", 0.0, 100.0, FaultBus::kLcm},
    {"second_autopilot", "", 0.0, 0.0, FaultBus::kCan},
    {"address_thief", "", 0.0, 0.0, FaultBus::kCan},
    {"strangers_order", ""},
    {"unknown_order", "", 0.0, 0.0, FaultBus::kLcm},
    {"cut_abort", "", 0.0, 0.0, FaultBus::kLcm},
    {"recorded_order", "", 0.0, 0.0, FaultBus::kLcm},
    {"interface_down", "", 0.0, 0.0, FaultBus::kCan, FaultFlight::kEither},
    {"error_passive", "", 0.0, 0.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"bus_off", "", 0.0, 0.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"netem", "", 0.0, 0.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"rudder_stuck", ""},
    {"planes_stuck", ""},
    {"no_thrust", ""},
    {"disengaged", ""},
    {"obstinate", ""},
    {"steerage_way", "mps", 0.1, 3.0},
    {"current", "mps", 0.0, 10.0},
    {"battery", "percent", 0.0, 100.0},
    {"leak", ""},
    {"ground_fault", ""},
    {"floor_rise", "metres", -11'000.0, 11'000.0},
    {"frozen", ""},
    {"position_error", "metres", -1e6, 1e6},
    {"heading_error", "degrees", -180.0, 180.0},
    {"depth_error", "metres", -11'000.0, 11'000.0},
    {"speed_error", "mps", -10.0, 10.0},
    {"position_drift", "mps", 0.0, 100.0},
    {"position_shiver", "metres", 0.0, 100.0},
    {"depth_drift", "mps", -10.0, 10.0},
    {"depth_stuck", "metres", -1e6, 1e6},
    {"deaf", ""},
    {"gain_error", "decibels", -120.0, 120.0},
    {"sound_dropout", "", 0.0, 0.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"sound_gain", "decibels", -120.0, 120.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"sound_open", "", 0.0, 0.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"sound_shorted", "", 0.0, 0.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"kill", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kEither},
    {"power_cut", "bytes", 1.0, 1e6},
    {"pause", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kEither},
    {"stop", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kEither},
    {"full_disk", "bytes", 10'000.0, 1e12, FaultBus::kEither, FaultFlight::kEither},
    {"slow_disk", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kAtSea},
    {"read_only_disk", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kAtSea},
    {"no_room", "frames_per_s", 1.0, 20'000.0, FaultBus::kCan, FaultFlight::kAtSea},
    {"wall_clock", "seconds", -1e6, 1e6, FaultBus::kEither, FaultFlight::kAtSea},
    {"flipped_bit", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kAtSea},
    {"file_gone", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kAtSea},
    {"bus_taken", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kAtSea},
    {"order", "", 0.0, 0.0, FaultBus::kEither, FaultFlight::kAtSea},
}};

[[nodiscard]] constexpr bool is_of_frames(Fault fault) {
  return static_cast<std::size_t>(fault) < kFrameFaults;
}
/// Whether it happens once, whatever its end is.
[[nodiscard]] constexpr bool is_of_a_moment(Fault fault) {
  return fault == Fault::kKill || fault == Fault::kPowerCut || fault == Fault::kStop || fault == Fault::kFlippedBit ||
         fault == Fault::kOrder;
}

/// Who sends Earshot's own frames, or messages, among the names of the devices.
inline constexpr std::string_view kEarshotsFrames = "earshot";
/// The senders whose messages a case over LCM may name.
inline constexpr std::string_view kLcmSenders[]{"autopilot", "navigation", "hydrophone", "vehicle-status", kEarshotsFrames};

/// The programs of a flight at sea, by which a case says whom a signal befalls.
inline constexpr std::string_view kEarshotsProgram = "earshotd";
inline constexpr std::string_view kVehiclesProgram = "vehicle";
/// What may be gone of a flight at sea when earshotd is started.
inline constexpr std::string_view kPolicyFile = "policy";
inline constexpr std::string_view kTablesFile = "tables";
inline constexpr std::string_view kMissionFile = "mission";
/// What somebody may order of a flight at sea.
inline constexpr std::string_view kAbortOrder = "abort";
inline constexpr std::string_view kPauseOrder = "pause";

/// A fault, when, and how much.
struct TimedFault {
  Fault fault = Fault::kLoss;
  Time from;                                 ///< since the flight began
  std::optional<Time> until = std::nullopt;  ///< nothing: to the end
  double amount = 0.0;                       ///< FaultTraits::amount
  double direction_deg = 0.0;                ///< clockwise from north, of those that has_direction() names
  double share = 1.0;                        ///< of the frames
  std::string device = {};  ///< whose frames (kDeviceNames or kEarshotsFrames; kLcmSenders), empty: everybody's; at sea, which of
                            ///< subjects_of()
  std::optional<std::uint32_t> pgn = std::nullopt;  ///< of which group
  std::string how = {};                             ///< of kNetem: "delay 50ms 20ms loss 5%"

  [[nodiscard]] bool acts_at(Time now) const { return now >= from && (!until || now < *until); }
  /// Whether it began since the last tick.
  [[nodiscard]] bool is_new_at(Time now, Duration tick) const { return from <= now && now < from + tick; }
  /// `amount` in its direction.
  [[nodiscard]] NorthEast vector() const;
  friend bool operator==(const TimedFault&, const TimedFault&) = default;
};

/// Which of several it befalls at sea, the usual one first: a program, a file, an order. Empty: there is but one.
[[nodiscard]] std::vector<std::string> subjects_of(Fault fault);
/// Whether it befalls the computer's CAN controller.
[[nodiscard]] bool is_of_controller(Fault fault);
/// Whether it befalls the hydrophone whose samples come over LCM.
[[nodiscard]] bool is_of_sound(Fault fault);
/// Whether the vehicle may truly be led out of its area by it: what is told of its place is a lie that goes on growing.
[[nodiscard]] bool leads_away(Fault fault);
/// Whether `direction_deg` says where to.
[[nodiscard]] bool has_direction(Fault fault);

/// "loss of 50 % of the compass's frames from 100 s for 20 s"
[[nodiscard]] std::string in_words(const TimedFault& fault);

}  // namespace earshot::hil
