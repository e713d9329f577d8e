#pragma once

#include "firmware/wire/n2k/table/attitude.hpp"
#include "firmware/wire/n2k/table/management.hpp"
#include "firmware/wire/n2k/table/place.hpp"
#include "firmware/wire/n2k/table/proprietary.hpp"
#include "firmware/wire/n2k/table/signal.hpp"
#include "firmware/wire/n2k/table/surroundings.hpp"

namespace earshot::n2k {

inline constexpr std::uint32_t kAcknowledgementPgn = 59392;
inline constexpr std::uint32_t kRequestPgn = 59904;
inline constexpr std::uint32_t kAddressClaimPgn = 60928;
inline constexpr std::uint32_t kCommandedAddressPgn = 65240;
inline constexpr std::uint32_t kGroupFunctionPgn = 126208;
inline constexpr std::uint32_t kPgnListPgn = 126464;
inline constexpr std::uint32_t kHeartbeatPgn = 126993;
inline constexpr std::uint32_t kProductPgn = 126996;
inline constexpr std::uint32_t kConfigurationPgn = 126998;

inline constexpr std::uint32_t kHeadingControlPgn = 127237;
inline constexpr std::uint32_t kRudderPgn = 127245;
inline constexpr std::uint32_t kHeadingPgn = 127250;
inline constexpr std::uint32_t kRateOfTurnPgn = 127251;
inline constexpr std::uint32_t kAttitudePgn = 127257;
inline constexpr std::uint32_t kVariationPgn = 127258;
inline constexpr std::uint32_t kChargePgn = 127506;
inline constexpr std::uint32_t kBatteryPgn = 127508;
inline constexpr std::uint32_t kSpeedPgn = 128259;
inline constexpr std::uint32_t kWaterDepthPgn = 128267;
inline constexpr std::uint32_t kDistanceLogPgn = 128275;
inline constexpr std::uint32_t kPositionPgn = 129025;
inline constexpr std::uint32_t kCoursePgn = 129026;
inline constexpr std::uint32_t kGnssPgn = 129029;
inline constexpr std::uint32_t kWindPgn = 130306;
inline constexpr std::uint32_t kTemperaturePgn = 130312;
inline constexpr std::uint32_t kPressurePgn = 130314;

inline constexpr std::uint32_t kSpeedDepthPgn = 65290;
inline constexpr std::uint32_t kSnrPgn = 65291;
inline constexpr std::uint32_t kAltitudePgn = 65292;
inline constexpr std::uint32_t kLeakPgn = 65293;
inline constexpr std::uint32_t kAutopilotStatusPgn = 65294;
inline constexpr std::uint32_t kPeerPgn = 126720;  ///< command, acknowledgement, abort: from one device to one other
inline constexpr std::uint32_t kHealthPgn = 130950;
inline constexpr std::uint32_t kPortHealthPgn = 130951;
inline constexpr std::uint32_t kDecisionPgn = 130952;
inline constexpr std::uint32_t kChallengePgn = 130953;

namespace table {

/// On request or on occasion: without a period.
inline constexpr Duration kOnOccasion{};

consteval Message single(std::string_view name, std::uint32_t pgn, std::uint8_t priority, Direction direction, Duration period,
                         std::span<const Signal> signals, std::uint8_t size = 8, std::uint8_t kind = 0) {
  return {.name = name,
          .pgn = pgn,
          .priority = priority,
          .size = size,
          .framing = Framing::kSingle,
          .direction = direction,
          .period = period,
          .timeout = ten_times(period),
          .handover = two_and_a_half_times(period),
          .signals = signals,
          .kind = kind};
}

consteval Message fast(std::string_view name, std::uint32_t pgn, std::uint8_t priority, Direction direction, Duration period,
                       std::span<const Signal> signals, std::uint8_t size, std::uint8_t kind = 0) {
  Message message = single(name, pgn, priority, direction, period, signals, size, kind);
  message.framing = Framing::kFast;
  return message;
}

consteval Message repeating(Message message, std::uint8_t repeated_bytes) {
  message.repeated_bytes = repeated_bytes;
  return message;
}

consteval Message by_transport(Message message) {
  message.framing = Framing::kTransport;
  return message;
}

using enum Direction;

// Periods: once a second, the pace of navigation and set-points in a mission, where the standard's own default is shorter.
inline constexpr Duration kSecond = Duration::seconds(1);

inline constexpr Message kHeading = single("VesselHeading", kHeadingPgn, 2, kToRuntime, kSecond, kHeadingSignals);
inline constexpr Message kPosition = single("PositionRapidUpdate", kPositionPgn, 2, kToRuntime, kSecond, kPositionSignals);
inline constexpr Message kSpeed = single("Speed", kSpeedPgn, 2, kToRuntime, kSecond, kSpeedSignals);
inline constexpr Message kPressure = single("ActualPressure", kPressurePgn, 5, kToRuntime, kSecond, kPressureSignals);
inline constexpr Message kHeadingControl =
    fast("HeadingTrackControl", kHeadingControlPgn, 2, kFromRuntime, kSecond, kHeadingControlSignals, 21);
inline constexpr Message kSpeedDepth = single("EarshotSpeedDepth", kSpeedDepthPgn, 3, kFromRuntime, kSecond, kSpeedDepthSignals);

inline constexpr Message kRudder = single("Rudder", kRudderPgn, 2, kToRuntime, kSecond, kRudderSignals);
inline constexpr Message kRateOfTurn = single("RateOfTurn", kRateOfTurnPgn, 2, kToRuntime, kSecond, kRateOfTurnSignals);
inline constexpr Message kAttitude = single("Attitude", kAttitudePgn, 3, kToRuntime, kSecond, kAttitudeSignals);
inline constexpr Message kVariation = single("MagneticVariation", kVariationPgn, 7, kToRuntime, kSecond, kVariationSignals);
inline constexpr Message kCharge = fast("DCDetailedStatus", kChargePgn, 6, kToRuntime, Duration::milliseconds(1500), kChargeSignals, 11);
inline constexpr Message kBattery = single("BatteryStatus", kBatteryPgn, 6, kToRuntime, Duration::milliseconds(1500), kBatterySignals);
inline constexpr Message kWaterDepth = single("WaterDepth", kWaterDepthPgn, 3, kToRuntime, kSecond, kWaterDepthSignals);
inline constexpr Message kDistanceLog = fast("DistanceLog", kDistanceLogPgn, 6, kToRuntime, kSecond, kDistanceLogSignals, 14);
inline constexpr Message kCourse = single("COGSOGRapidUpdate", kCoursePgn, 2, kToRuntime, kSecond, kCourseSignals);
inline constexpr Message kGnss = fast("GNSSPositionData", kGnssPgn, 3, kToRuntime, kSecond, kGnssSignals, 43);
inline constexpr Message kWind = single("WindData", kWindPgn, 2, kToRuntime, kSecond, kWindSignals);
inline constexpr Message kTemperature = single("Temperature", kTemperaturePgn, 5, kToRuntime, Duration::seconds(2), kTemperatureSignals);

inline constexpr Message kAcknowledgement =
    single("ISOAcknowledgement", kAcknowledgementPgn, 6, kBoth, kOnOccasion, kAcknowledgementSignals);
inline constexpr Message kRequest = single("ISORequest", kRequestPgn, 6, kBoth, kOnOccasion, kRequestSignals, 3);
inline constexpr Message kAddressClaim = single("ISOAddressClaim", kAddressClaimPgn, 6, kBoth, kOnOccasion, kAddressClaimSignals);
inline constexpr Message kCommandedAddress =
    by_transport(single("ISOCommandedAddress", kCommandedAddressPgn, 6, kToRuntime, kOnOccasion, kCommandedAddressSignals, 9));
/// Stands in no list of messages: the first byte of a group function says which of seven layouts it has, and this is one of them.
inline constexpr Message kGroupAcknowledgement =
    fast("AcknowledgeGroupFunction", kGroupFunctionPgn, 3, kBoth, kOnOccasion, kGroupAcknowledgementSignals, 6);
inline constexpr Message kPgnList = repeating(fast("PGNList", kPgnListPgn, 6, kBoth, kOnOccasion, kPgnListSignals, 4), 3);
inline constexpr Message kHeartbeat = single("Heartbeat", kHeartbeatPgn, 7, kBoth, Duration::seconds(60), kHeartbeatSignals);
inline constexpr Message kProduct = fast("ProductInformation", kProductPgn, 6, kBoth, kOnOccasion, kProductSignals, 134);
inline constexpr Message kConfiguration =
    fast("ConfigurationInformation", kConfigurationPgn, 6, kBoth, kOnOccasion, kConfigurationSignals, 6);

inline constexpr Message kSnr = single("EarshotSNR", kSnrPgn, 5, kBoth, kSecond, kSnrSignals);
inline constexpr Message kAltitude = single("EarshotAltitude", kAltitudePgn, 5, kToRuntime, kSecond, kAltitudeSignals);
inline constexpr Message kLeak = single("EarshotLeak", kLeakPgn, 1, kToRuntime, kSecond, kLeakSignals);
inline constexpr Message kAutopilotStatus =
    single("EarshotAutopilotStatus", kAutopilotStatusPgn, 3, kToRuntime, kSecond, kAutopilotStatusSignals);

/// One of our own messages, by its list in firmware/messages/dictionary.
template <messages::IsDescribed Message>
consteval n2k::Message own(std::string_view name, std::uint32_t pgn, Duration period) {
  return fast(name, pgn, 6, kFromRuntime, period, kGroupOf<Message>, bytes_of(kGroupOf<Message>));
}
/// Likewise, one of the kinds that share a group.
template <messages::IsDescribed Message>
consteval n2k::Message peers(std::string_view name, Direction direction, std::string_view kind) {
  return fast(name, kPeerPgn, 3, direction, kOnOccasion, kPeerGroupOf<Message>, bytes_of(kPeerGroupOf<Message>),
              static_cast<std::uint8_t>(raw_of(kPeers, kind)));
}

// What a policy saw and weighed (observation and logits) is in the journal only: 384 bytes more.
inline constexpr Message kHealth = own<messages::Health>("EarshotHealth", kHealthPgn, kSecond);
inline constexpr Message kPortHealth = own<messages::PortReport>("EarshotPortHealth", kPortHealthPgn, kSecond);
inline constexpr Message kDecision = own<messages::Decision>("EarshotDecision", kDecisionPgn, kOnOccasion);
inline constexpr Message kChallenge = own<messages::PublishedChallenge>("EarshotChallenge", kChallengePgn, kSecond);
inline constexpr Message kCommand = peers<messages::OperatorCommand>("EarshotCommand", kToRuntime, "command");
inline constexpr Message kCommandAcknowledgement =
    peers<messages::CommandAcknowledgement>("EarshotCommandAcknowledgement", kFromRuntime, "acknowledgement");
inline constexpr Message kAbort = single("EarshotAbort", kPeerPgn, 3, kToRuntime, kOnOccasion, kAbortSignals, 8, raw_of(kPeers, "abort"));

// A bare array: of a std::array whose type is deduced, GCC 12 makes a variable that could be written.
inline constexpr Message kMessages[]{
    kHeading,
    kPosition,
    kSpeed,
    kPressure,
    kHeadingControl,
    kSpeedDepth,
    kRudder,
    kRateOfTurn,
    kAttitude,
    kVariation,
    kCharge,
    kBattery,
    kWaterDepth,
    kDistanceLog,
    kCourse,
    kGnss,
    kWind,
    kTemperature,
    kAcknowledgement,
    kRequest,
    kAddressClaim,
    kCommandedAddress,
    kPgnList,
    kHeartbeat,
    kProduct,
    kConfiguration,
    kSnr,
    kAltitude,
    kLeak,
    kAutopilotStatus,
    kHealth,
    kPortHealth,
    kDecision,
    kChallenge,
    kCommand,
    kCommandAcknowledgement,
    kAbort,
};

}  // namespace table
}  // namespace earshot::n2k
