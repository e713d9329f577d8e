#pragma once

#include "firmware/wire/n2k/table/choices.hpp"

namespace earshot::n2k::table {

// Where the vehicle is, how fast, and over what.

inline constexpr Scale kTenMillionth{1, 10'000'000};
inline constexpr Scale kSixteenDigits{1, 1e16};
inline constexpr Scale kMillionth{1, 1'000'000};

inline constexpr Signal kSpeedSignals[]{
    sequence_identifier(0),
    number("SpeedWaterReferenced", 8, 16, kUnsigned, kHundredth, "m/s"),
    number("SpeedGroundReferenced", 24, 16, kUnsigned, kHundredth, "m/s"),
    choice("SpeedWaterReferencedType", 40, 8, kWaterReference),
    number("SpeedDirection", 48, 4),
};

inline constexpr Signal kWaterDepthSignals[]{
    sequence_identifier(0),
    number("Depth", 8, 32, kUnsigned, kHundredth, "m"),
    number("Offset", 40, 16, kSigned, kThousandth, "m"),
    number("Range", 56, 8, kUnsigned, {10, 1}, "m"),
};

inline constexpr Signal kDistanceLogSignals[]{
    date("Date", 0),
    time_of_day("Time", 16),
    number("Log", 48, 32, kUnsigned, kOne, "m"),
    number("TripLog", 80, 32, kUnsigned, kOne, "m"),
};

inline constexpr Signal kPositionSignals[]{
    within(-90, 90, number("Latitude", 0, 32, kSigned, kTenMillionth, "deg")),
    within(-180, 180, number("Longitude", 32, 32, kSigned, kTenMillionth, "deg")),
};

inline constexpr Signal kCourseSignals[]{
    sequence_identifier(0),
    choice("COGReference", 8, 2, kDirectionReference),
    direction("COG", 16),
    number("SOG", 32, 16, kUnsigned, kHundredth, "m/s"),
};

// Behind the last come the reference stations, as many as it says.
inline constexpr Signal kGnssSignals[]{
    sequence_identifier(0),
    date("Date", 8),
    time_of_day("Time", 24),
    within(-90, 90, number("Latitude", 56, 64, kSigned, kSixteenDigits, "deg")),
    within(-180, 180, number("Longitude", 120, 64, kSigned, kSixteenDigits, "deg")),
    number("Altitude", 184, 64, kSigned, kMillionth, "m"),
    choice("GNSSType", 248, 4, kGnssType),
    choice("Method", 252, 4, kGnssMethod),
    choice("Integrity", 256, 2, kGnssIntegrity, Special::kNone),
    number("NumberOfSVs", 264, 8),
    number("HDOP", 272, 16, kSigned, kHundredth),
    number("PDOP", 288, 16, kSigned, kHundredth),
    number("GeoidalSeparation", 304, 32, kSigned, kHundredth, "m"),
    number("ReferenceStations", 336, 8),
};

/// Of one reference station: whose corrections a position uses. Bits from its own first byte.
inline constexpr Signal kReferenceStationSignals[]{
    choice("ReferenceStationType", 0, 4, kGnssType),
    number("ReferenceStationID", 4, 12),
    number("AgeOfDGNSSCorrections", 16, 16, kUnsigned, kHundredth, "s"),
};
inline constexpr std::size_t kReferenceStationBytes = 4;

}  // namespace earshot::n2k::table
