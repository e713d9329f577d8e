#pragma once

#include "firmware/wire/n2k/table/choices.hpp"

namespace earshot::n2k::table {

// Water, air and the battery.

inline constexpr Signal kWindSignals[]{
    sequence_identifier(0),
    number("WindSpeed", 8, 16, kUnsigned, kHundredth, "m/s"),
    direction("WindAngle", 24),
    choice("Reference", 40, 3, kWindReference),
};

inline constexpr Signal kTemperatureSignals[]{
    sequence_identifier(0),
    number("Instance", 8, 8),
    choice("Source", 16, 8, kTemperatureSource),
    number("ActualTemperature", 24, 16, kUnsigned, kHundredth, "K"),
    number("SetTemperature", 40, 16, kUnsigned, kHundredth, "K"),
};

inline constexpr Signal kPressureSignals[]{
    sequence_identifier(0),
    number("Instance", 8, 8),
    choice("Source", 16, 8, kPressureSource),
    number("Pressure", 24, 32, kSigned, kTenth, "Pa"),
};

inline constexpr Signal kBatterySignals[]{
    number("Instance", 0, 8),
    number("Voltage", 8, 16, kSigned, kHundredth, "V"),
    number("Current", 24, 16, kSigned, kTenth, "A"),
    number("Temperature", 40, 16, kUnsigned, kHundredth, "K"),
    sequence_identifier(56),
};

inline constexpr Signal kChargeSignals[]{
    sequence_identifier(0),
    number("Instance", 8, 8),
    choice("DCType", 16, 8, kDcType),
    number("StateOfCharge", 24, 8, kUnsigned, kOne, "%"),
    number("StateOfHealth", 32, 8, kUnsigned, kOne, "%"),
    number("TimeRemaining", 40, 16, kUnsigned, {60, 1}, "s"),
    number("RippleVoltage", 56, 16, kUnsigned, kThousandth, "V"),
    number("RemainingCapacity", 72, 16, kUnsigned, kOne, "Ah"),
};

}  // namespace earshot::n2k::table
