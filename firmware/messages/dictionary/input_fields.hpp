#pragma once

#include "firmware/messages/autopilot_status.hpp"
#include "firmware/messages/bearing_measurement.hpp"
#include "firmware/messages/dictionary/message.hpp"
#include "firmware/messages/hydrophone_status.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/messages/port_report.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/messages/unsent_setpoints.hpp"
#include "firmware/messages/vehicle_status.hpp"

namespace earshot::messages {

// What the runtime receives of the vehicle and its sea.

inline constexpr n2k::Choice kLeakStates[]{{0, "dry"}, {1, "wet"}};

template <>
struct Described<Navigation> {
  static constexpr std::string_view kType = "nav_state_t";
  static constexpr std::string_view kChannel = "EARSHOT_NAV_STATE";
  static constexpr std::string_view kMeaning = "Where the vehicle is. Frame: the mission's north-east plane, depth positive down.";
  static constexpr LineList kFields{
      field<&Navigation::time>("utime", {.meaning = "when it was valid, microseconds, UTC by the wall clock", .key = "valid_time_s"}),
      field<&Navigation::position, &NorthEast::north>("north_m"),
      field<&Navigation::position, &NorthEast::east>("east_m"),
      field<&Navigation::depth>("depth_m"),
      field<&Navigation::heading>("heading_rad", {.meaning = "clockwise from north"}),
      field<&Navigation::speed>("speed_mps", {.meaning = "through the water; NaN: not known"}),
  };
};

template <>
struct Described<SnrMeasurement> {
  static constexpr std::string_view kType = "snr_estimate_t";
  static constexpr std::string_view kChannel = "EARSHOT_SNR_ESTIMATE";
  static constexpr std::string_view kMeaning = "SNR at the hydrophone.";
  static constexpr LineList kFields{
      field<&SnrMeasurement::time>(
          "utime", {.meaning = "end of the interval it was measured over, microseconds, UTC by the wall clock", .key = "valid_time_s"}),
      field<&SnrMeasurement::snr>(
          "snr_db", {.bus = on_bus::within(-600, 600, on_bus::number("SNR", 16, 18, on_bus::kSigned, on_bus::kHundredth, "dB"))}),
      field<&SnrMeasurement::too_faint>(
          "too_faint", {.meaning = "not measured: the signal lies somewhere below snr_db, the least that could have been measured",
                        .bus = on_bus::number("TooFaint", 34, 2)}),
  };
};

template <>
struct Described<BearingMeasurement> {
  static constexpr std::string_view kType = "bearing_t";
  static constexpr std::string_view kChannel = "EARSHOT_BEARING";
  static constexpr std::string_view kMeaning =
      "From where the source is heard, as an array of hydrophones measures it. It comes beside snr_estimate_t.\n"
      "Angles are true, clockwise from north, 0 to 2 pi.";
  static constexpr LineList kFields{
      field<&BearingMeasurement::time>(
          "utime", {.meaning = "end of the interval it was measured over, microseconds, UTC by the wall clock", .key = "valid_time_s"}),
      field<&BearingMeasurement::bearing, &Bearing::direction>("bearing_rad", {.meaning = "of the source from the vehicle"}),
      field<&BearingMeasurement::bearing, &Bearing::deviation>(
          "deviation_rad", {.meaning = "standard deviation of bearing_rad, above 0 and at most pi", .key = "bearing_deviation_rad"}),
      whether_there<&BearingMeasurement::bearing, &Bearing::mirror_axis>(
          "ambiguous",
          {.meaning = "left and right cannot be distinguished: 2 axis_rad - bearing_rad is as likely", .key = "bearing_ambiguous"}),
      field<&BearingMeasurement::bearing, &Bearing::mirror_axis>(
          "axis_rad", {.meaning = "of the array, when it was measured; looked at only when ambiguous", .key = "bearing_axis_rad"}),
      field<&BearingMeasurement::sender>("sender", {.meaning = "who measured it: a number of its own, where there is more than one array"}),
  };
};

template <>
struct Described<VehicleStatus> {
  static constexpr std::string_view kType = "vehicle_status_t";
  static constexpr std::string_view kChannel = "EARSHOT_VEHICLE_STATUS";
  static constexpr std::string_view kMeaning = "How the vehicle is. What it does not measure is NaN, or false.";
  static constexpr LineList kFields{
      field<&VehicleStatus::time>("utime", {.key = "valid_time_s"}),
      field<&VehicleStatus::altitude>("altitude_m",
                                      {.meaning = "above the sea floor; NaN: no bottom is heard",
                                       .bus = on_bus::number("Altitude", 24, 32, on_bus::kUnsigned, on_bus::kHundredth, "m")}),
      field<&VehicleStatus::battery_percent>("battery_percent", {.meaning = "charge that is left; NaN: not known"}),
      field<&VehicleStatus::has_leak>("leak", {.meaning = "water in the hull", .bus = on_bus::choice("State", 24, 2, kLeakStates)}),
      field<&VehicleStatus::has_ground_fault>("ground_fault",
                                              {.meaning = "current between battery and hull", .bus = on_bus::number("GroundFault", 26, 2)}),
  };
};

template <>
struct Described<AutopilotStatus> {
  static constexpr std::string_view kType = "autopilot_status_t";
  static constexpr std::string_view kChannel = "EARSHOT_AUTOPILOT_STATUS";
  static constexpr std::string_view kMeaning = "What the autopilot reports of itself.";
  static constexpr LineList kFields{
      field<&AutopilotStatus::time>("utime", {.key = "valid_time_s"}),
      field<&AutopilotStatus::follows_setpoints>(
          "follows_setpoints", {.meaning = "false: a person or another mission steers", .bus = on_bus::number("FollowsSetpoints", 16, 2)}),
  };
};

template <>
struct Described<HydrophoneStatus> {
  static constexpr std::string_view kType = "hydrophone_status_t";
  static constexpr std::string_view kChannel = "EARSHOT_HYDROPHONE_STATUS";
  static constexpr std::string_view kMeaning = "What a hydrophone reports of itself.";
  static constexpr LineList kFields{
      field<&HydrophoneStatus::time>("utime", {.key = "valid_time_s"}),
      field<&HydrophoneStatus::is_deaf>(
          "deaf", {.meaning = "its samples are still, clipped or below the noise of any sea", .bus = on_bus::number("Deaf", 60, 2)}),
  };
};

template <>
struct Described<PortReport> {
  static constexpr std::string_view kType = "port_report_t";
  static constexpr std::string_view kChannel = "EARSHOT_PORT_REPORT";
  static constexpr std::string_view kMeaning =
      "What one port of the runtime reports of itself; counters only grow. In the journal, and in health_t.\n"
      "A hydrophone's port counts samples of one channel in `received` and `lost`.";
  static constexpr LineList kFields{
      field<&PortReport::port>(
          "port",
          {.meaning = "its index in the mission file, counted from 1", .key = "reported_port", .bus = on_bus::number("Port", 16, 8)}),
      field<&PortReport::link_up>("link_up",
                                  {.meaning = "false: it cannot be read or written at present", .bus = on_bus::number("LinkUp", 24, 2)}),
      field<&PortReport::received>("received", {.meaning = "messages handed on", .bus = on_bus::counter("Received", 32)}),
      field<&PortReport::lost>("lost", {.meaning = "arrived faster than they were taken", .bus = on_bus::counter("Lost", 80)}),
      field<&PortReport::malformed>("malformed",
                                    {.meaning = "no message of ours, or not of its format", .bus = on_bus::counter("Malformed", 128)}),
      field<&PortReport::unsent>("unsent", {.meaning = "could not be put on the bus", .bus = on_bus::counter("Unsent", 176)}),
  };
};

template <>
struct Described<UnsentSetpoints> {
  static constexpr std::string_view kType = "unsent_setpoints_t";
  static constexpr std::string_view kChannel = "EARSHOT_UNSENT_SETPOINTS";
  static constexpr std::string_view kMeaning =
      "No port could send the last turn's set-point. In the journal, channel EARSHOT_UNSENT_SETPOINTS.0.";
  static constexpr LineList kFields{
      field<&UnsentSetpoints::count>("count", {.meaning = "of the whole mission so far, this one included"}),
  };
};

}  // namespace earshot::messages
