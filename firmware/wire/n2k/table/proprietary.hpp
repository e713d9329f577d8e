#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "firmware/messages/dictionary/command_fields.hpp"
#include "firmware/messages/dictionary/input_fields.hpp"
#include "firmware/messages/dictionary/output_fields.hpp"
#include "firmware/wire/n2k/table/choices.hpp"
#include "firmware/wire/n2k/table/own_group.hpp"

namespace earshot::n2k::table {

// Ours: what no standard group carries. A proprietary group begins with the maker's code; 2044, the highest that the field can hold, is
// assigned to nobody known to canboat and must become the vehicle maker's own before it sails with strangers' devices.

inline constexpr std::int64_t kManufacturer = 2044;
inline constexpr std::int64_t kMarineIndustry = raw_of(kIndustry, "Marine Industry");

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
// Single frames of what a vehicle's messages hold, as far as it fits. What else is in them stands in no message, and is written here: who
// made the frame, what belongs together (HeadingSequence, SID), which compartment it is of (Instance), and the level that only who reads
// the bus looks at (BandLevel).

// HeadingSequence is the sequence counter of the fast packet (127237) that brings the heading of the same set-point.
// ReleaseWeight has the half of the byte that the sequence, 0 to 7, leaves: "No" is as it was when all of the byte was the sequence's.
inline constexpr Signal kSpeedDepthSignals[]{
    manufacturer(),
    industry(),
    signal_of<&messages::Setpoint::speed>(),
    signal_of<&messages::Setpoint::depth>(),
    number("HeadingSequence", 56, 4),
    signal_of<&messages::Setpoint::release_weight>(),
};
static_assert(carry_all_of<messages::Setpoint>(kSpeedDepthSignals));

inline constexpr Signal kSnrSignals[]{
    manufacturer(),
    industry(),
    signal_of<&messages::SnrMeasurement::snr>(),
    signal_of<&messages::SnrMeasurement::too_faint>(),
    number("BandLevel", 36, 16, kUnsigned, kHundredth, "dB re 1 uPa"),
    sequence_identifier(52),
    signal_of<&messages::HydrophoneStatus::is_deaf>(),
};
static_assert(carry_all_of<messages::SnrMeasurement>(kSnrSignals) && carry_all_of<messages::HydrophoneStatus>(kSnrSignals));

inline constexpr Signal kAltitudeSignals[]{
    manufacturer(),
    industry(),
    sequence_identifier(16),
    signal_of<&messages::VehicleStatus::altitude>(),
};

inline constexpr Signal kLeakSignals[]{
    manufacturer(),
    industry(),
    number("Instance", 16, 8),
    signal_of<&messages::VehicleStatus::has_leak>(),
    signal_of<&messages::VehicleStatus::has_ground_fault>(),
};
static_assert(carry_all_of<messages::VehicleStatus>(kAltitudeSignals, kLeakSignals));

// HeadingSequence is that of the last set-point that was taken (65290).
inline constexpr Signal kAutopilotStatusSignals[]{
    manufacturer(),
    industry(),
    signal_of<&messages::AutopilotStatus::follows_setpoints>(),
    number("HeadingSequence", 24, 8),
};
static_assert(carry_all_of<messages::AutopilotStatus>(kAutopilotStatusSignals));

inline constexpr Signal kHead[]{manufacturer(), industry()};
inline constexpr Signal kPeerHead[]{manufacturer(), industry(), message_kind()};
template <messages::IsDescribed Message>
inline constexpr std::array<Signal, std::size(kHead) + signal_count<Message>()> kGroupOf = group_of<Message>(kHead);
template <messages::IsDescribed Message>
inline constexpr std::array<Signal, std::size(kPeerHead) + signal_count<Message>()> kPeerGroupOf = group_of<Message>(kPeerHead);

// One frame that aborts, for senders that cannot cut a fast packet. It is given when it arrives.
inline constexpr Signal kAbortSignals[]{
    manufacturer(),
    industry(),
    message_kind(),
    number("AbortIssuer", 24, 16, kUnsigned, kOne, "", Special::kNone),
    number("AbortNumber", 40, 24, kUnsigned, kOne, "", Special::kNone),
};

}  // namespace earshot::n2k::table
