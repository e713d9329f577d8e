#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "firmware/messages/dictionary/command_fields.hpp"
#include "firmware/messages/dictionary/output_fields.hpp"
#include "firmware/wire/n2k/table/choices.hpp"
#include "firmware/wire/n2k/table/own_group.hpp"

namespace earshot::n2k::table {

// Ours: what no standard group carries. A proprietary group begins with the maker's code; 2044, the highest that the field can hold, is
// assigned to nobody known to canboat and must become the vehicle maker's own before it sails with strangers' devices.

inline constexpr std::int64_t kManufacturer = 2044;
inline constexpr std::int64_t kMarineIndustry = raw_of(kIndustry, "Marine Industry");

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
