#pragma once

#include "firmware/wire/n2k/table/choices.hpp"

namespace earshot::n2k::table {

// Who is on the bus, and what it can do.

/// A parameter group's number.
consteval Signal pgn_number(std::string_view name, unsigned first_bit) {
  return within(0, 0x3FFFF, number(name, first_bit, 24));
}

/// A number without "not available".
consteval Signal every_value(std::string_view name, unsigned first_bit, unsigned bit_count) {
  return number(name, first_bit, bit_count, kUnsigned, kOne, "", Special::kNone);
}

inline constexpr Signal kAcknowledgementSignals[]{
    choice("Control", 0, 8, kIsoControl),
    number("GroupFunction", 8, 8),
    pgn_number("PGN", 40),
};

inline constexpr Signal kRequestSignals[]{pgn_number("PGN", 0)};

inline constexpr Signal kAddressClaimSignals[]{
    number("UniqueNumber", 0, 21),
    number("ManufacturerCode", 21, 11),
    every_value("DeviceInstanceLower", 32, 3),
    every_value("DeviceInstanceUpper", 35, 5),
    number("DeviceFunction", 40, 8),
    choice("DeviceClass", 49, 7, kDeviceClass),
    number("SystemInstance", 56, 4),
    choice("IndustryGroup", 60, 3, kIndustry),
    choice("ArbitraryAddressCapable", 63, 1, kYesNo, Special::kNone),
};

inline constexpr Signal kCommandedAddressSignals[]{
    every_value("UniqueNumber", 0, 21),        number("ManufacturerCode", 21, 11),       every_value("DeviceInstanceLower", 32, 3),
    every_value("DeviceInstanceUpper", 35, 5), number("DeviceFunction", 40, 8),          choice("DeviceClass", 49, 7, kDeviceClass),
    number("SystemInstance", 56, 4),           choice("IndustryCode", 60, 3, kIndustry), number("NewSourceAddress", 64, 8),
};

/// Of a group function that acknowledges another. Each parameter of the other may have four bits of its own behind the number.
inline constexpr Signal kGroupAcknowledgementSignals[]{
    every_value("FunctionCode", 0, 8),          pgn_number("PGN", 8),
    choice("PGNErrorCode", 32, 4, kGroupError), number("IntervalOrPriorityErrorCode", 36, 4),
    number("NumberOfParameters", 40, 8),
};

inline constexpr Signal kPgnListSignals[]{
    choice("FunctionCode", 0, 8, kPgnListFunction),
    pgn_number("PGN", 8),
};

inline constexpr Signal kHeartbeatSignals[]{
    number("DataTransmitOffset", 0, 16, kUnsigned, kThousandth, "s"),
    number("SequenceCounter", 16, 8),
    choice("Controller1State", 24, 2, kControllerState),
    choice("Controller2State", 26, 2, kControllerState),
    choice("EquipmentStatus", 28, 2, kEquipmentStatus),
};

inline constexpr Signal kProductSignals[]{
    number("NMEA2000Version", 0, 16, kUnsigned, kThousandth),
    number("ProductCode", 16, 16),
    fixed_text("ModelID", 32, 32),
    fixed_text("SoftwareVersionCode", 288, 32),
    fixed_text("ModelVersion", 544, 32),
    fixed_text("ModelSerialCode", 800, 32),
    choice("CertificationLevel", 1056, 8, kCertificationLevel),
    number("LoadEquivalency", 1064, 8),
};

inline constexpr Signal kConfigurationSignals[]{
    variable_text("InstallationDescription1", 0),
    variable_text("InstallationDescription2", 1),
    variable_text("ManufacturerInformation", 2),
};

}  // namespace earshot::n2k::table
