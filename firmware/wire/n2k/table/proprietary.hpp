#pragma once

#include "firmware/wire/n2k/table/choices.hpp"

namespace earshot::n2k::table {

// Ours: what no standard group carries. A proprietary group begins with the maker's code; 2044, the highest that the field can hold, is
// assigned to nobody known to canboat and must become the vehicle maker's own before it sails with strangers' devices.

inline constexpr std::int64_t kManufacturer = 2044;
inline constexpr std::int64_t kMarineIndustry = raw_of(kIndustry, "Marine Industry");

inline constexpr Choice kOrders[]{{1, "START"}, {2, "COMPLETE"}, {3, "ABORT"}, {4, "LISTEN"}, {5, "PAUSE"}, {6, "RESUME"}, {7, "TIGHTEN"}};
inline constexpr Choice kOutcomes[]{{0, "obeyed"},
                                    {1, "repeated"},
                                    {2, "too old"},
                                    {3, "expired"},
                                    {4, "not in this state"},
                                    {5, "unknown order"},
                                    {6, "not configured"},
                                    {7, "out of order"},
                                    {8, "not verified"},
                                    {9, "not tighter"},
                                    {10, "autopilot silent"},
                                    {11, "old mark"},
                                    {12, "unreadable"},
                                    {13, "obeyed, not durable"}};
inline constexpr Choice kMissionStates[]{{0, "STANDBY"}, {1, "SEARCH"}, {2, "DONE"}, {3, "ABORT"}};
inline constexpr Choice kEndReasons[]{{0, "not over"},         {1, "completed"},    {2, "steps used up"},       {3, "operator abort"},
                                      {4, "navigation stale"}, {5, "SNR stale"},    {6, "left operating area"}, {7, "time used up"},
                                      {8, "safety rule"},      {9, "memory fault"}, {10, "declared found"},     {11, "outage"}};
inline constexpr Choice kAuthorities[]{{0, "DISCONNECTED"}, {1, "STANDBY"}, {2, "LISTEN"}, {3, "COMMAND"}, {4, "ABORT"}};
inline constexpr Choice kLeakStates[]{{0, "dry"}, {1, "wet"}};
inline constexpr Choice kPeers[]{{1, "command"}, {2, "acknowledgement"}, {3, "abort"}};

consteval Signal manufacturer() {
  return number("ManufacturerCode", 0, 11);
}
consteval Signal industry() {
  return choice("IndustryGroup", 13, 3, kIndustry);
}
consteval Signal message_kind() {
  return choice("Kind", 16, 8, kPeers);
}
/// Microseconds since the epoch of the mission clock (UTC at sea).
consteval Signal instant(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 64, kSigned, {1, 1'000'000}, "s");
}
/// Drawn or counted by a sender: all 32 bits are numbers.
consteval Signal any_number(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 32, kUnsigned, kOne, "", Special::kNone);
}
/// What only grows: 9 years at a million a second; more stays at the highest.
consteval Signal counter(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 48);
}
consteval Signal metres(std::string_view name, unsigned first_bit) {
  return number(name, first_bit, 32, kSigned, kHundredth, "m");
}

// HeadingSequence is the sequence counter of the fast packet (127237) that brings the heading of the same set-point.
// ReleaseWeight has the half of the byte that the sequence, 0 to 7, leaves: "No" is as it was when all of the byte was the sequence's.
inline constexpr Signal kSpeedDepthSignals[]{
    manufacturer(),
    industry(),
    number("CommandedSpeed", 16, 16, kUnsigned, kHundredth, "m/s"),
    within(0, 12'000, number("CommandedDepth", 32, 24, kUnsigned, kHundredth, "m")),
    number("HeadingSequence", 56, 4),
    choice("ReleaseWeight", 60, 4, kYesNo),
};

inline constexpr Signal kSnrSignals[]{
    manufacturer(),
    industry(),
    within(-600, 600, number("SNR", 16, 18, kSigned, kHundredth, "dB")),
    choice("TooFaint", 34, 2, kYesNo),
    number("BandLevel", 36, 16, kUnsigned, kHundredth, "dB re 1 uPa"),
    sequence_identifier(52),
    choice("Deaf", 60, 2, kYesNo),
};

inline constexpr Signal kAltitudeSignals[]{
    manufacturer(),
    industry(),
    sequence_identifier(16),
    number("Altitude", 24, 32, kUnsigned, kHundredth, "m"),
};

inline constexpr Signal kLeakSignals[]{
    manufacturer(), industry(), number("Instance", 16, 8), choice("State", 24, 2, kLeakStates), choice("GroundFault", 26, 2, kYesNo),
};

// HeadingSequence is that of the last set-point that was taken (65290).
inline constexpr Signal kAutopilotStatusSignals[]{
    manufacturer(),
    industry(),
    choice("FollowsSetpoints", 16, 2, kYesNo),
    number("HeadingSequence", 24, 8),
};

inline constexpr Signal kHealthSignals[]{
    manufacturer(),
    industry(),
    instant("Time", 16),
    choice("State", 80, 8, kMissionStates),
    choice("EndReason", 88, 8, kEndReasons),
    any_number("StepsTaken", 96),
    counter("NavigationRefused", 128),
    counter("SNRRefused", 176),
    counter("CommandsRefused", 224),
    counter("SetpointsLimited", 272),
    number("Ports", 320, 8),
    counter("Turn", 328),
    any_number("Decisions", 376),
    choice("Authority", 408, 4, kAuthorities),
    choice("Paused", 412, 2, kYesNo),
    counter("StatusRefused", 416),
};

inline constexpr Signal kPortHealthSignals[]{
    manufacturer(),          industry(),          number("Port", 16, 8),     choice("LinkUp", 24, 2, kYesNo),
    counter("Received", 32), counter("Lost", 80), counter("Malformed", 128), counter("Unsent", 176),
};

// What a policy saw and weighed (observation and logits) is in the journal only: 384 bytes more.
inline constexpr Signal kDecisionSignals[]{
    manufacturer(),
    industry(),
    instant("Time", 16),
    any_number("Step", 80),
    metres("North", 112),
    metres("East", 144),
    within(-600, 600, number("SNR", 176, 18, kSigned, kHundredth, "dB")),
    choice("TooFaint", 194, 2, kYesNo),
    choice("Detected", 196, 2, kYesNo),
    choice("Overridden", 198, 2, kYesNo),
    number("Action", 200, 8),
    metres("WaypointNorth", 208),
    metres("WaypointEast", 240),
    metres("LikeliestNorth", 272),
    metres("LikeliestEast", 304),
    metres("MeanNorth", 336),
    metres("MeanEast", 368),
    number("Spread", 400, 32, kUnsigned, kHundredth, "m"),
    within(0, 1, number("LikeliestShare", 432, 16, kUnsigned, {1, 60'000})),
    number("EffectiveCells", 448, 32, kUnsigned, kHundredth),
};

// The limits of a TIGHTEN: "not available" leaves one as it is. The mark: zeros where the vehicle's mission names no key.
inline constexpr Signal kCommandSignals[]{
    manufacturer(),
    industry(),
    message_kind(),
    choice("Order", 24, 8, kOrders),
    any_number("Issuer", 32),
    any_number("Number", 64),
    instant("Time", 96),
    instant("Expiry", 160),
    within(0, 12'000, number("MaxDepth", 224, 24, kUnsigned, kHundredth, "m")),
    number("MaxSpeed", 248, 16, kUnsigned, kHundredth, "m/s"),
    number("MaxTime", 264, 32, kUnsigned, kOne, "s"),
    any_number("Mark0", 296),
    any_number("Mark1", 328),
    any_number("Mark2", 360),
    any_number("Mark3", 392),
};

inline constexpr Signal kCommandAcknowledgementSignals[]{
    manufacturer(),
    industry(),
    message_kind(),
    choice("Order", 24, 8, kOrders),
    any_number("Issuer", 32),
    any_number("Number", 64),
    choice("Outcome", 96, 8, kOutcomes),
    instant("Time", 104),
};

// Four bytes each, little-endian, of what challenge_t says: nonce, vehicle, mission, mark.
inline constexpr Signal kChallengeSignals[]{
    manufacturer(),
    industry(),
    instant("Time", 16),
    any_number("Nonce0", 80),
    any_number("Nonce1", 112),
    any_number("Nonce2", 144),
    any_number("Nonce3", 176),
    any_number("Vehicle0", 208),
    any_number("Vehicle1", 240),
    any_number("Vehicle2", 272),
    any_number("Vehicle3", 304),
    any_number("Vehicle4", 336),
    any_number("Vehicle5", 368),
    any_number("Vehicle6", 400),
    any_number("Vehicle7", 432),
    any_number("Mission0", 464),
    any_number("Mission1", 496),
    any_number("Mission2", 528),
    any_number("Mission3", 560),
    any_number("Mission4", 592),
    any_number("Mission5", 624),
    any_number("Mission6", 656),
    any_number("Mission7", 688),
    any_number("ChallengeMark0", 720),
    any_number("ChallengeMark1", 752),
    any_number("ChallengeMark2", 784),
    any_number("ChallengeMark3", 816),
};

// One frame that aborts, for senders that cannot cut a fast packet. It is given when it arrives.
inline constexpr Signal kAbortSignals[]{
    manufacturer(),
    industry(),
    message_kind(),
    number("AbortIssuer", 24, 16, kUnsigned, kOne, "", Special::kNone),
    number("AbortNumber", 40, 24, kUnsigned, kOne, "", Special::kNone),
};

}  // namespace earshot::n2k::table
