#pragma once

#include "firmware/wire/n2k/table/signal.hpp"

namespace earshot::n2k::table {

// Closed lists of the standard. Source: canboat's definitions 8.0.0-beta3 (Apache-2.0), after NMEA 2000.
// Oracle: the peer test against PyPI's nmea2000, which compares every name.

inline constexpr Choice kYesNo[]{{0, "No"}, {1, "Yes"}};
inline constexpr Choice kDirectionReference[]{{0, "True"}, {1, "Magnetic"}, {2, "Error"}};
inline constexpr Choice kSteeringMode[]{{0, "Main Steering"},    {1, "Non-Follow-Up Device"},
                                        {2, "Follow-Up Device"}, {3, "Heading Control Standalone"},
                                        {4, "Heading Control"},  {5, "Track Control"}};
inline constexpr Choice kTurnMode[]{{0, "Rudder limit controlled"}, {1, "Turn rate controlled"}, {2, "Radius controlled"}};
inline constexpr Choice kRudderDirection[]{{0, "No Order"}, {1, "Move to starboard"}, {2, "Move to port"}};
inline constexpr Choice kWaterReference[]{
    {0, "Paddle wheel"}, {1, "Pitot tube"}, {2, "Doppler"}, {3, "Correlation (ultra sound)"}, {4, "Electro Magnetic"}};
inline constexpr Choice kPressureSource[]{{0, "Atmospheric"},      {1, "Water"},     {2, "Steam"},
                                          {3, "Compressed Air"},   {4, "Hydraulic"}, {5, "Filter"},
                                          {6, "AltimeterSetting"}, {7, "Oil"},       {8, "Fuel"}};
inline constexpr Choice kTemperatureSource[]{{0, "Sea Temperature"},
                                             {1, "Outside Temperature"},
                                             {2, "Inside Temperature"},
                                             {3, "Engine Room Temperature"},
                                             {4, "Main Cabin Temperature"},
                                             {5, "Live Well Temperature"},
                                             {6, "Bait Well Temperature"},
                                             {7, "Refrigeration Temperature"},
                                             {8, "Heating System Temperature"},
                                             {9, "Dew Point Temperature"},
                                             {10, "Apparent Wind Chill Temperature"},
                                             {11, "Theoretical Wind Chill Temperature"},
                                             {12, "Heat Index Temperature"},
                                             {13, "Freezer Temperature"},
                                             {14, "Exhaust Gas Temperature"},
                                             {15, "Shaft Seal Temperature"}};
inline constexpr Choice kDcType[]{{0, "Battery"}, {1, "Alternator"}, {2, "Convertor"}, {3, "Solar cell"}, {4, "Wind generator"}};
inline constexpr Choice kWindReference[]{{0, "True (ground referenced to North)"},
                                         {1, "Magnetic (ground referenced to Magnetic North)"},
                                         {2, "Apparent"},
                                         {3, "True (boat referenced)"},
                                         {4, "True (water referenced)"}};
inline constexpr Choice kVariationSource[]{{0, "Manual"},   {1, "Automatic Chart"}, {2, "Automatic Table"}, {3, "Automatic Calculation"},
                                           {4, "WMM 2000"}, {5, "WMM 2005"},        {6, "WMM 2010"},        {7, "WMM 2015"},
                                           {8, "WMM 2020"}, {9, "WMM 2025"}};
inline constexpr Choice kGnssType[]{
    {0, "GPS"},    {1, "GLONASS"},    {2, "GPS+GLONASS"}, {3, "GPS+SBAS/WAAS"}, {4, "GPS+SBAS/WAAS+GLONASS"},
    {5, "Chayka"}, {6, "integrated"}, {7, "surveyed"},    {8, "Galileo"}};
inline constexpr Choice kGnssMethod[]{{0, "no GNSS"},           {1, "GNSS fix"},  {2, "DGNSS fix"},           {3, "Precise GNSS"},
                                      {4, "RTK Fixed Integer"}, {5, "RTK float"}, {6, "Estimated (DR) mode"}, {7, "Manual Input"},
                                      {8, "Simulate mode"}};
inline constexpr Choice kGnssIntegrity[]{{0, "No integrity checking"}, {1, "Safe"}, {2, "Caution"}, {3, "Unsafe"}};
inline constexpr Choice kIsoControl[]{{0, "ACK"}, {1, "NAK"}, {2, "Access Denied"}, {3, "Address Busy"}};
inline constexpr Choice kGroupError[]{
    {0, "Acknowledge"},   {1, "PGN not supported"}, {2, "PGN not available"},          {3, "Access denied"},
    {4, "Not supported"}, {5, "Tag not supported"}, {6, "Read or Write not supported"}};
inline constexpr Choice kControllerState[]{{0, "Error Active"}, {1, "Error Passive"}, {2, "Bus Off"}};
inline constexpr Choice kEquipmentStatus[]{{0, "Operational"}, {1, "Fault"}};
inline constexpr Choice kPgnListFunction[]{{0, "Transmit PGN list"}, {1, "Receive PGN list"}};
inline constexpr Choice kCertificationLevel[]{{0, "Level A"}, {1, "Level B"}};
inline constexpr Choice kIndustry[]{{0, "Global"},       {1, "Highway"},         {2, "Agriculture"},
                                    {3, "Construction"}, {4, "Marine Industry"}, {5, "Industrial"}};
inline constexpr Choice kDeviceClass[]{{0, "Reserved for 2000 Use"},
                                       {10, "System tools"},
                                       {20, "Safety systems"},
                                       {25, "Internetwork device"},
                                       {30, "Electrical Distribution"},
                                       {35, "Electrical Generation"},
                                       {40, "Steering and Control surfaces"},
                                       {50, "Propulsion"},
                                       {60, "Navigation"},
                                       {70, "Communication"},
                                       {75, "Sensor Communication Interface"},
                                       {80, "Instrumentation/general systems"},
                                       {85, "External Environment"},
                                       {90, "Internal Environment"},
                                       {100, "Deck + cargo + fishing equipment systems"},
                                       {110, "Human Interface"},
                                       {120, "Display"},
                                       {125, "Entertainment"}};

}  // namespace earshot::n2k::table
