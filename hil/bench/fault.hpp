#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"

namespace earshot::hil {

/// What a case of the bench does to a mission.
enum class Fault : std::uint8_t {
  // Of frames on the bus, or messages over LCM.
  kLoss,          ///< a frame never arrives
  kDelay,         ///< arrives `seconds` later, behind what was said meanwhile
  kJitter,        ///< arrives up to `seconds` later, so that frames overtake each other
  kDuplication,   ///< arrives twice
  kCorruption,    ///< one bit of its data is another, as no CAN controller would let pass
  kNotAvailable,  ///< all its data say "not available" (ones; over LCM NaN)
  kTruncation,    ///< has only the first half of its data
  kWrongLength,   ///< a fast packet's first frame says another length (CAN only)
  kReplay,        ///< arrives once more `seconds` later, word for word: a log that somebody plays back
  kReordering,    ///< of what is said in one turn, those that it hits change places (LCM only)
  kDateError,     ///< is dated `seconds` ahead (LCM only: no frame bears a date)
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

/// On which buses there is such a fault.
enum class FaultBus : std::uint8_t { kEither, kCan, kLcm };

/// How a case with such a fault can be flown.
enum class FaultFlight : std::uint8_t { kLockStep, kAtSea, kEither };

/// What a fault hits.
enum class FaultTarget : std::uint8_t {
  kFrames,      ///< on the bus, or messages over LCM
  kBus,         ///< and who is on it
  kController,  ///< the computer's CAN controller
  kVehicle,     ///< and its instruments
  kSound,       ///< of the hydrophone whose samples come over LCM
  kComputer,
};

/// The programs of a flight at sea, by which a case says whom a signal hits.
inline constexpr std::string_view kEarshotsProgram = "earshotd";
inline constexpr std::string_view kVehiclesProgram = "vehicle";
/// What may be gone of a flight at sea when earshotd is started.
inline constexpr std::string_view kPolicyFile = "policy";
inline constexpr std::string_view kTablesFile = "tables";
inline constexpr std::string_view kMissionFile = "mission";
/// What somebody may order of a flight at sea.
inline constexpr std::string_view kAbortOrder = "abort";
inline constexpr std::string_view kPauseOrder = "pause";

inline constexpr std::array kPrograms{kEarshotsProgram, kVehiclesProgram};
inline constexpr std::array kFiles{kPolicyFile, kTablesFile, kMissionFile};
inline constexpr std::array kOrders{kAbortOrder, kPauseOrder};

/// All that is known of a fault but how it is made.
struct FaultTraits {
  Fault fault;
  std::string_view word;  ///< in files
  FaultTarget hits;
  std::string_view amount = {};  ///< key of the number that says how much of it there is, its end the unit; empty: there is none
  double lowest = 0.0;
  double highest = 0.0;
  FaultBus bus = FaultBus::kEither;
  FaultFlight flight = FaultFlight::kLockStep;
  bool is_of_a_moment = false;  ///< it happens once, whatever its end is
  bool has_direction = false;   ///< `direction_deg` says where to
  /// The vehicle may truly be led out of its area by it: what is told of its place is a lie that goes on growing.
  bool leads_away = false;
  /// Which of several it hits at sea, the usual one first: a program, a file, an order. Empty: there is but one.
  std::span<const std::string_view> subjects = {};
};

/// In the order of Fault; fault.cpp does not compile while a fault has no row.
inline constexpr auto kFaultTraits = std::to_array<FaultTraits>({
    {.fault = Fault::kLoss, .word = "loss", .hits = FaultTarget::kFrames},
    {.fault = Fault::kDelay, .word = "delay", .hits = FaultTarget::kFrames, .amount = "seconds", .lowest = 0.1, .highest = 600.0},
    {.fault = Fault::kJitter, .word = "jitter", .hits = FaultTarget::kFrames, .amount = "seconds", .lowest = 0.1, .highest = 600.0},
    {.fault = Fault::kDuplication, .word = "duplication", .hits = FaultTarget::kFrames},
    {.fault = Fault::kCorruption, .word = "corruption", .hits = FaultTarget::kFrames},
    {.fault = Fault::kNotAvailable, .word = "not_available", .hits = FaultTarget::kFrames},
    {.fault = Fault::kTruncation, .word = "truncation", .hits = FaultTarget::kFrames},
    {.fault = Fault::kWrongLength, .word = "wrong_length", .hits = FaultTarget::kFrames, .bus = FaultBus::kCan},
    {.fault = Fault::kReplay, .word = "replay", .hits = FaultTarget::kFrames, .amount = "seconds", .lowest = 0.1, .highest = 3600.0},
    {.fault = Fault::kReordering, .word = "reordering", .hits = FaultTarget::kFrames, .bus = FaultBus::kLcm},
    {.fault = Fault::kDateError,
     .word = "date_error",
     .hits = FaultTarget::kFrames,
     .amount = "seconds",
     .lowest = -1e6,
     .highest = 1e6,
     .bus = FaultBus::kLcm},
    {.fault = Fault::kFlood, .word = "flood", .hits = FaultTarget::kBus, .amount = "frames_per_s", .lowest = 1.0, .highest = 20'000.0},
    {.fault = Fault::kNavigationFlood,
     .word = "navigation_flood",
     .hits = FaultTarget::kBus,
     .amount = "messages_per_s",
     .lowest = 1.0,
     .highest = 3.0,
     .bus = FaultBus::kLcm},
    {.fault = Fault::kSecondNavigation,
     .word = "second_navigation",
     .hits = FaultTarget::kBus,
     .amount = "metres_off",
     .lowest = 0.0,
     .highest = 1e6,
     .has_direction = true},
    {.fault = Fault::kWalkingNavigation,
     .word = "walking_navigation",
     .hits = FaultTarget::kBus,
     .amount = "mps",
     .lowest = 0.0,
     .highest = 100.0,
     .bus = FaultBus::kLcm,
     .has_direction = true,
     .leads_away = true},
    {.fault = Fault::kPausingNavigation,
     .word = "pausing_navigation",
     .hits = FaultTarget::kBus,
     .amount = "mps",
     .lowest = 0.0,
     .highest = 100.0,
     .bus = FaultBus::kLcm,
     .has_direction = true,
     .leads_away = true},
    {.fault = Fault::kSecondAutopilot, .word = "second_autopilot", .hits = FaultTarget::kBus, .bus = FaultBus::kCan},
    {.fault = Fault::kAddressThief, .word = "address_thief", .hits = FaultTarget::kBus, .bus = FaultBus::kCan},
    {.fault = Fault::kStrangersOrder, .word = "strangers_order", .hits = FaultTarget::kBus},
    {.fault = Fault::kUnknownOrder, .word = "unknown_order", .hits = FaultTarget::kBus, .bus = FaultBus::kLcm},
    {.fault = Fault::kCutAbort, .word = "cut_abort", .hits = FaultTarget::kBus, .bus = FaultBus::kLcm},
    {.fault = Fault::kRecordedOrder, .word = "recorded_order", .hits = FaultTarget::kBus, .bus = FaultBus::kLcm},
    {.fault = Fault::kInterfaceDown,
     .word = "interface_down",
     .hits = FaultTarget::kBus,
     .bus = FaultBus::kCan,
     .flight = FaultFlight::kEither},
    {.fault = Fault::kErrorPassive,
     .word = "error_passive",
     .hits = FaultTarget::kController,
     .bus = FaultBus::kCan,
     .flight = FaultFlight::kAtSea},
    {.fault = Fault::kBusOff, .word = "bus_off", .hits = FaultTarget::kController, .bus = FaultBus::kCan, .flight = FaultFlight::kAtSea},
    {.fault = Fault::kNetem, .word = "netem", .hits = FaultTarget::kBus, .bus = FaultBus::kCan, .flight = FaultFlight::kAtSea},
    {.fault = Fault::kRudderStuck, .word = "rudder_stuck", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kPlanesStuck, .word = "planes_stuck", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kNoThrust, .word = "no_thrust", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kDisengaged, .word = "disengaged", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kObstinate, .word = "obstinate", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kSteerageWay, .word = "steerage_way", .hits = FaultTarget::kVehicle, .amount = "mps", .lowest = 0.1, .highest = 3.0},
    {.fault = Fault::kCurrent,
     .word = "current",
     .hits = FaultTarget::kVehicle,
     .amount = "mps",
     .lowest = 0.0,
     .highest = 10.0,
     .has_direction = true},
    {.fault = Fault::kBattery, .word = "battery", .hits = FaultTarget::kVehicle, .amount = "percent", .lowest = 0.0, .highest = 100.0},
    {.fault = Fault::kLeak, .word = "leak", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kGroundFault, .word = "ground_fault", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kFloorRise,
     .word = "floor_rise",
     .hits = FaultTarget::kVehicle,
     .amount = "metres",
     .lowest = -11'000.0,
     .highest = 11'000.0},
    {.fault = Fault::kFrozen, .word = "frozen", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kPositionError,
     .word = "position_error",
     .hits = FaultTarget::kVehicle,
     .amount = "metres",
     .lowest = -1e6,
     .highest = 1e6,
     .has_direction = true},
    {.fault = Fault::kHeadingError,
     .word = "heading_error",
     .hits = FaultTarget::kVehicle,
     .amount = "degrees",
     .lowest = -180.0,
     .highest = 180.0},
    {.fault = Fault::kDepthError,
     .word = "depth_error",
     .hits = FaultTarget::kVehicle,
     .amount = "metres",
     .lowest = -11'000.0,
     .highest = 11'000.0},
    {.fault = Fault::kSpeedError, .word = "speed_error", .hits = FaultTarget::kVehicle, .amount = "mps", .lowest = -10.0, .highest = 10.0},
    {.fault = Fault::kPositionDrift,
     .word = "position_drift",
     .hits = FaultTarget::kVehicle,
     .amount = "mps",
     .lowest = 0.0,
     .highest = 100.0,
     .has_direction = true,
     .leads_away = true},
    {.fault = Fault::kPositionShiver,
     .word = "position_shiver",
     .hits = FaultTarget::kVehicle,
     .amount = "metres",
     .lowest = 0.0,
     .highest = 100.0},
    {.fault = Fault::kDepthDrift, .word = "depth_drift", .hits = FaultTarget::kVehicle, .amount = "mps", .lowest = -10.0, .highest = 10.0},
    {.fault = Fault::kDepthStuck, .word = "depth_stuck", .hits = FaultTarget::kVehicle, .amount = "metres", .lowest = -1e6, .highest = 1e6},
    {.fault = Fault::kDeaf, .word = "deaf", .hits = FaultTarget::kVehicle},
    {.fault = Fault::kGainError,
     .word = "gain_error",
     .hits = FaultTarget::kVehicle,
     .amount = "decibels",
     .lowest = -120.0,
     .highest = 120.0},
    {.fault = Fault::kSoundDropout,
     .word = "sound_dropout",
     .hits = FaultTarget::kSound,
     .bus = FaultBus::kCan,
     .flight = FaultFlight::kAtSea},
    {.fault = Fault::kSoundGain,
     .word = "sound_gain",
     .hits = FaultTarget::kSound,
     .amount = "decibels",
     .lowest = -120.0,
     .highest = 120.0,
     .bus = FaultBus::kCan,
     .flight = FaultFlight::kAtSea},
    {.fault = Fault::kSoundOpen, .word = "sound_open", .hits = FaultTarget::kSound, .bus = FaultBus::kCan, .flight = FaultFlight::kAtSea},
    {.fault = Fault::kSoundShorted,
     .word = "sound_shorted",
     .hits = FaultTarget::kSound,
     .bus = FaultBus::kCan,
     .flight = FaultFlight::kAtSea},
    {.fault = Fault::kKill,
     .word = "kill",
     .hits = FaultTarget::kComputer,
     .flight = FaultFlight::kEither,
     .is_of_a_moment = true,
     .subjects = kPrograms},
    {.fault = Fault::kPowerCut,
     .word = "power_cut",
     .hits = FaultTarget::kComputer,
     .amount = "bytes",
     .lowest = 1.0,
     .highest = 1e6,
     .is_of_a_moment = true},
    {.fault = Fault::kPause, .word = "pause", .hits = FaultTarget::kComputer, .flight = FaultFlight::kEither, .subjects = kPrograms},
    {.fault = Fault::kStop,
     .word = "stop",
     .hits = FaultTarget::kComputer,
     .flight = FaultFlight::kEither,
     .is_of_a_moment = true,
     .subjects = kPrograms},
    {.fault = Fault::kFullDisk,
     .word = "full_disk",
     .hits = FaultTarget::kComputer,
     .amount = "bytes",
     .lowest = 10'000.0,
     .highest = 1e12,
     .flight = FaultFlight::kEither},
    {.fault = Fault::kSlowDisk, .word = "slow_disk", .hits = FaultTarget::kComputer, .flight = FaultFlight::kAtSea},
    {.fault = Fault::kReadOnlyDisk, .word = "read_only_disk", .hits = FaultTarget::kComputer, .flight = FaultFlight::kAtSea},
    {.fault = Fault::kNoRoom,
     .word = "no_room",
     .hits = FaultTarget::kComputer,
     .amount = "frames_per_s",
     .lowest = 1.0,
     .highest = 20'000.0,
     .bus = FaultBus::kCan,
     .flight = FaultFlight::kAtSea},
    {.fault = Fault::kWallClock,
     .word = "wall_clock",
     .hits = FaultTarget::kComputer,
     .amount = "seconds",
     .lowest = -1e6,
     .highest = 1e6,
     .flight = FaultFlight::kAtSea},
    {.fault = Fault::kFlippedBit,
     .word = "flipped_bit",
     .hits = FaultTarget::kComputer,
     .flight = FaultFlight::kAtSea,
     .is_of_a_moment = true},
    {.fault = Fault::kFileGone, .word = "file_gone", .hits = FaultTarget::kComputer, .flight = FaultFlight::kAtSea, .subjects = kFiles},
    {.fault = Fault::kBusTaken, .word = "bus_taken", .hits = FaultTarget::kComputer, .flight = FaultFlight::kAtSea},
    {.fault = Fault::kOrder,
     .word = "order",
     .hits = FaultTarget::kComputer,
     .flight = FaultFlight::kAtSea,
     .is_of_a_moment = true,
     .subjects = kOrders},
});

[[nodiscard]] constexpr const FaultTraits& traits_of(Fault fault) {
  return kFaultTraits.at(static_cast<std::size_t>(fault));
}

/// The bench does not know how to make a fault there: it stands in the table, and nobody has written what makes it.
class NoMaker : public std::logic_error {
 public:
  /// @param where  "of the vehicle"
  NoMaker(Fault fault, std::string_view where);
};

/// Who sends Earshot's own frames, or messages, among the names of the devices.
inline constexpr std::string_view kEarshotsFrames = "earshot";
/// The senders whose messages a case over LCM may name.
inline constexpr std::string_view kLcmSenders[]{"autopilot", "navigation", "hydrophone", "vehicle-status", kEarshotsFrames};

/// A fault, when, and how much.
struct TimedFault {
  Fault fault = Fault::kLoss;
  Time from;                                 ///< since the flight began
  std::optional<Time> until = std::nullopt;  ///< nothing: to the end
  double amount = 0.0;                       ///< FaultTraits::amount
  double direction_deg = 0.0;                ///< clockwise from north, of those that have one
  double share = 1.0;                        ///< of the frames
  std::string device = {};  ///< whose frames (kDeviceNames or kEarshotsFrames; kLcmSenders), empty: everybody's; at sea, which of
                            ///< FaultTraits::subjects
  std::optional<std::uint32_t> pgn = std::nullopt;  ///< of which group
  std::string how = {};                             ///< of kNetem: "delay 50ms 20ms loss 5%"

  [[nodiscard]] bool acts_at(Time now) const { return now >= from && (!until || now < *until); }
  /// Whether it began since the last tick.
  [[nodiscard]] bool is_new_at(Time now, Duration tick) const { return from <= now && now < from + tick; }
  [[nodiscard]] const FaultTraits& traits() const { return traits_of(fault); }
  /// `amount` in its direction.
  [[nodiscard]] NorthEast vector() const;
  friend bool operator==(const TimedFault&, const TimedFault&) = default;
};

/// "loss of 50 % of the compass's frames from 100 s for 20 s"
[[nodiscard]] std::string to_string(const TimedFault& fault);

}  // namespace earshot::hil
