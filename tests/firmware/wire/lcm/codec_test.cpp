#include "firmware/wire/lcm/codec.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "earshot/autopilot_status_t.hpp"
#include "earshot/bearing_t.hpp"
#include "earshot/board_t.hpp"
#include "earshot/challenge_t.hpp"
#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/controller_trouble_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/detection_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/hearing_t.hpp"
#include "earshot/hydrophone_status_t.hpp"
#include "earshot/journal_end_t.hpp"
#include "earshot/journal_part_t.hpp"
#include "earshot/journal_resumed_t.hpp"
#include "earshot/mission_t.hpp"
#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "earshot/port_report_t.hpp"
#include "earshot/safety_event_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "earshot/unsent_setpoints_t.hpp"
#include "earshot/vehicle_status_t.hpp"
#include "firmware/detector/hydrophone/settings_fields.hpp"
#include "firmware/messages/dictionary/every_message.hpp"
#include "tests/firmware/wire/golden/every_message.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::wire {
namespace {

template <class Message>
std::vector<std::uint8_t> written(const Message& message, Time sent = kSampleTime) {
  const Encoded encoded(message, sent);
  return {encoded.bytes().begin(), encoded.bytes().end()};
}

/// lcm-gen's own type reads these bytes, and writes the same.
template <class Type, class Message>
void expect_agreement(const Message& message) {
  const std::vector<std::uint8_t> ours = written(message);
  Type peer{};
  ASSERT_EQ(support::read_peer(ours, peer), Status::kOk) << Type::getTypeName();
  EXPECT_EQ(support::bytes_of(peer), ours) << Type::getTypeName();
  EXPECT_EQ(std::string(messages::Described<Message>::kType), Type::getTypeName());
}

/// Whose type is whose; never called.
struct Peer {
  static nav_state_t of(const messages::Navigation&);
  static snr_estimate_t of(const messages::SnrMeasurement&);
  static bearing_t of(const messages::BearingMeasurement&);
  static vehicle_status_t of(const messages::VehicleStatus&);
  static autopilot_status_t of(const messages::AutopilotStatus&);
  static hydrophone_status_t of(const messages::HydrophoneStatus&);
  static unsent_setpoints_t of(const messages::UnsentSetpoints&);
  static port_report_t of(const messages::PortReport&);
  static operator_command_t of(const messages::OperatorCommand&);
  static command_acknowledgement_t of(const messages::CommandAcknowledgement&);
  static challenge_t of(const messages::PublishedChallenge&);
  static decision_t of(const messages::Decision&);
  static safety_event_t of(const messages::SafetyEvent&);
  static detection_t of(const messages::SoundDetection&);
};

TEST(LcmCodec, WritesWhatLcmGensOwnTypesReadAndWrite) {
  const auto agree = [](std::string_view /*name*/, const auto& message) { expect_agreement<decltype(Peer::of(message))>(message); };
  for_each_sample_input(agree);
  for_each_sample_output(agree);
  expect_agreement<setpoint_t>(kSampleSetpoint);
  for (const bool has_all_fields : {false, true}) {
    expect_agreement<health_t>(sample_health(has_all_fields));
    expect_agreement<mission_t>(messages::MissionRecord{.mission = sample_mission(has_all_fields), .policy_crc32 = 1, .tables_crc32 = 2});
  }
  expect_agreement<journal_end_t>(messages::ClosingRecord{.time = kSampleTime});
  expect_agreement<journal_part_t>(messages::JournalPart{.part = 2, .first_record_crc32 = 3});
  expect_agreement<journal_resumed_t>(messages::JournalResumed{.time = kSampleTime, .cut_bytes = 4});
  expect_agreement<controller_trouble_t>(messages::ControllerTrouble{.time = kSampleTime, .port = 5, .is_there = true});
  expect_agreement<hearing_t>(detector::fin_whale());
  expect_agreement<board_t>(messages::BoardReport{.time = kSampleTime, .event = messages::BoardEvent::kDecided, .turn_us = 6});
}

template <class Message>
Message back(const Message& message) {
  Message read{};
  EXPECT_EQ(decode(written(message), read), Status::kOk);
  return read;
}

TEST(LcmCodec, ReadsEveryMessageBack) {
  const auto is_back = [](std::string_view name, const auto& message) {
    EXPECT_EQ(written(back(message)), written(message)) << name;  // a number that is not known is no NaN's equal
  };
  for_each_sample_input(is_back);
  for_each_sample_output(is_back);
  EXPECT_EQ(back(kSampleSetpoint), kSampleSetpoint);
  for (const bool has_all_fields : {false, true}) {
    const messages::MissionRecord record{.mission = sample_mission(has_all_fields), .policy_crc32 = 1, .tables_crc32 = 2};
    EXPECT_EQ(back(record), record);
    EXPECT_EQ(written(back(sample_health(has_all_fields))), written(sample_health(has_all_fields)));
    EXPECT_EQ(back(sample_health(has_all_fields)).ports, sample_health(has_all_fields).ports);
  }
}

TEST(LcmCodec, TellsWhenAMessageWasSentThatDoesNotHoldItsDate) {
  messages::Setpoint read;
  Time sent;
  ASSERT_EQ(decode(written(kSampleSetpoint, Time{77}), read, &sent), Status::kOk);
  EXPECT_EQ(sent, Time{77});
}

TEST(LcmCodec, RefusesAnotherTypesBytesAndAnyOtherLengthAndLeavesTheMessageAsItWas) {
  const std::vector<std::uint8_t> autopilot = written(messages::AutopilotStatus{.time = kSampleTime, .follows_setpoints = true});
  messages::HydrophoneStatus other{.time = Time{3}, .is_deaf = true};
  EXPECT_EQ(decode(autopilot, other), Status::kMalformed) << "of the same length";
  EXPECT_EQ(other, (messages::HydrophoneStatus{.time = Time{3}, .is_deaf = true}));
  messages::AutopilotStatus read;
  std::vector<std::uint8_t> longer = autopilot;
  longer.push_back(0);
  EXPECT_EQ(decode(longer, read), Status::kMalformed);
  for (std::size_t size = 0; size < autopilot.size(); ++size)
    EXPECT_EQ(decode(std::span(autopilot).first(size), read), Status::kMalformed) << size;
}

TEST(LcmCodec, CutsCountsToWhatThereIsRoomFor) {
  std::vector<std::uint8_t> bytes = written(sample_health(true));
  const std::size_t count = bytes.size() - config::kMaxPorts * (kLcmSize<messages::PortReport> - kLcmFingerprintBytes) - 1;
  ASSERT_EQ(bytes[count], config::kMaxPorts);
  messages::Health health;
  for (const std::uint8_t impossible : {std::uint8_t{100}, std::uint8_t{0xFF}}) {
    bytes[count] = impossible;  // 100 and -1
    ASSERT_EQ(decode(bytes, health), Status::kOk);
    EXPECT_EQ(health.ports.size(), impossible == 100 ? config::kMaxPorts : 0U);
  }
}

TEST(LcmCodec, CutsPolygonsAndRulesOfAMissionLikewise) {
  const messages::MissionRecord full{.mission = sample_mission(true)};
  mission_t message = support::as_peer<mission_t>(full);
  message.rules = 100;
  message.corners[0] = 100;
  const auto mission = support::from_peer<messages::MissionRecord>(message);
  EXPECT_EQ(mission.mission.safety.rules.size(), config::kMaxOwnRules);
  EXPECT_EQ(mission.mission.safety.fence->inside.size(), config::kMaxPolygonCorners);
  message.rules = -1;
  EXPECT_TRUE(support::from_peer<messages::MissionRecord>(message).mission.safety.rules.empty());
}

TEST(LcmCodec, TellsAnOrdersMarkInItsThreeWaysAndTakesNoFourth) {
  auto order = support::as_peer<operator_command_t>(sample_order());
  EXPECT_EQ(order.verified, 0);
  EXPECT_EQ(support::as_peer<operator_command_t>(sample_tightening()).verified, 1);
  order.verified = 2;
  EXPECT_TRUE(support::from_peer<messages::OperatorCommand>(order).has_old_mark);
  order.verified = 3;
  EXPECT_FALSE(support::from_peer<messages::OperatorCommand>(order).is_verified);
  EXPECT_FALSE(support::from_peer<messages::OperatorCommand>(order).has_old_mark);
}

TEST(LcmCodec, LeavesAnAxisThatIsSaidAloneToNobody) {
  bearing_t bearing{};
  bearing.axis_rad = 0.75;
  EXPECT_FALSE(support::from_peer<messages::BearingMeasurement>(bearing).bearing.mirror_axis);
}

TEST(LcmCodec, TakesOfADeclarationWhatItsDecisionSaysItself) {
  const messages::Decision decision = back(sample_decision(true));
  ASSERT_TRUE(decision.found);
  const messages::FoundDeclaration& format = *decision.found;
  EXPECT_EQ(format.snr, Decibels{-7.25});
  EXPECT_EQ(format.likeliest, at(500.5, 250.5));
  EXPECT_EQ(format.measurement, 9U);
  EXPECT_EQ(format.near_measurements, 0U) << "which nobody is told";
}

TEST(LcmCodec, CarriesCountersBeyondThirtyTwoBitsAndNumbersOfSendersAsTheyLieInMemory) {
  messages::Health health;
  health.counters.setpoints_limited = (std::uint64_t{1} << 63U) - 1;
  EXPECT_EQ(support::as_peer<health_t>(health).setpoints_limited, 9'223'372'036'854'775'807);
  EXPECT_EQ(support::as_peer<operator_command_t>(sample_order()).issuer, static_cast<std::int32_t>(4'000'000'001U));
  EXPECT_EQ(back(sample_order()).issuer, 4'000'000'001U);
}

}  // namespace
}  // namespace earshot::wire
