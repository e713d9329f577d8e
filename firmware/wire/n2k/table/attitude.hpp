#pragma once

#include "firmware/wire/n2k/table/choices.hpp"

namespace earshot::n2k::table {

// Which way the vehicle looks and turns. Layouts, scales and ranges here and in the other tables.
// Source: canboat's definitions 8.0.0-beta3 (Apache-2.0), after NMEA 2000.
// Oracle: Signals tests on frames recorded from real buses (tests/reference/n2k); the peer test against PyPI's nmea2000

inline constexpr Signal kHeadingSignals[]{
    sequence_identifier(0),
    direction("Heading", 8),
    angle("Deviation", 24),
    angle("Variation", 40),
    choice("Reference", 56, 2, kDirectionReference),
};

inline constexpr Signal kRateOfTurnSignals[]{
    sequence_identifier(0),
    number("Rate", 8, 32, kSigned, {1, 32'000'000}, "rad/s"),
};

inline constexpr Signal kAttitudeSignals[]{
    sequence_identifier(0),
    angle("Yaw", 8),
    angle("Pitch", 24),
    angle("Roll", 40),
};

inline constexpr Signal kVariationSignals[]{
    sequence_identifier(0),
    choice("Source", 8, 4, kVariationSource),
    date("AgeOfService", 16),
    angle("Variation", 32),
};

inline constexpr Signal kRudderSignals[]{
    number("Instance", 0, 8),
    choice("DirectionOrder", 8, 3, kRudderDirection),
    angle("AngleOrder", 16),
    angle("Position", 32),
};

inline constexpr Signal kHeadingControlSignals[]{
    choice("RudderLimitExceeded", 0, 2, kYesNo),
    choice("OffHeadingLimitExceeded", 2, 2, kYesNo),
    choice("OffTrackLimitExceeded", 4, 2, kYesNo),
    choice("Override", 6, 2, kYesNo),
    choice("SteeringMode", 8, 3, kSteeringMode),
    choice("TurnMode", 11, 3, kTurnMode),
    choice("HeadingReference", 14, 2, kDirectionReference),
    choice("CommandedRudderDirection", 21, 3, kRudderDirection),
    angle("CommandedRudderAngle", 24),
    direction("HeadingToSteer", 40),
    direction("Track", 56),
    direction("RudderLimit", 72),
    direction("OffHeadingLimit", 88),
    number("RadiusOfTurnOrder", 104, 16, kSigned, kOne, "m"),
    number("RateOfTurnOrder", 120, 16, kSigned, {1, 32'000}, "rad/s"),
    number("OffTrackLimit", 136, 16, kSigned, kOne, "m"),
    direction("VesselHeading", 152),
};

}  // namespace earshot::n2k::table
