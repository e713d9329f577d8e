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

}  // namespace earshot::n2k::table
