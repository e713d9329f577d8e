#include "firmware/wire/journal/input_record.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <variant>

#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::wire {
namespace {

using messages::Input;

const Input kFix{.arrival = Time{70},
                 .port = 1,
                 .sequence = 12,
                 .value = messages::Navigation{.time = Time{5},
                                               .position = {Meters{1.0}, Meters{2.0}},
                                               .depth = Meters{3.0},
                                               .heading = Radians{0.5},
                                               .speed = MetersPerSecond{1.5}}};
const Input kMeasurement{.arrival = Time{71},
                         .port = 0,
                         .sequence = 13,
                         .value = messages::SnrMeasurement{.time = Time{6}, .snr = Decibels{-7.5}, .too_faint = true}};
const Input kCommand{.arrival = Time{72},
                     .port = 7,
                     .sequence = 14,
                     .value = messages::OperatorCommand{.time = Time{7},
                                                        .expiry = Time{8},
                                                        .issuer = 9,
                                                        .number = 10,
                                                        .order = messages::Order::kTighten,
                                                        .limits = {.max_depth = Meters{120.0}, .max_speed = {}, .max_time_s = 60.0},
                                                        .mark = {1, 2, 3, 250},
                                                        .is_verified = true}};
const Input kReport{.arrival = Time{73},
                    .port = 2,
                    .sequence = 15,
                    .value = messages::PortReport{.port = 2, .link_up = false, .received = 11, .lost = 12, .malformed = 13, .unsent = 14}};

const Input kBearing{
    .arrival = Time{74},
    .port = 3,
    .sequence = 16,
    .value = messages::BearingMeasurement{.time = Time{8},
                                          .bearing = {.direction = Radians{1.5}, .deviation = Radians{0.25}, .mirror_axis = Radians{0.75}},
                                          .sender = 4'000'000'000}};

const Input kVehicle{
    .arrival = Time{76},
    .port = 4,
    .sequence = 18,
    .value = messages::VehicleStatus{.time = Time{9}, .altitude = Meters{12.5}, .battery_percent = 80.5, .has_leak = true}};
const Input kAutopilot{
    .arrival = Time{77}, .port = 5, .sequence = 19, .value = messages::AutopilotStatus{.time = Time{10}, .follows_setpoints = true}};
const Input kHydrophone{
    .arrival = Time{78}, .port = 6, .sequence = 20, .value = messages::HydrophoneStatus{.time = Time{11}, .is_deaf = true}};
const Input kUnsent{.arrival = Time{75}, .port = 0, .sequence = 17, .value = messages::UnsentSetpoints{.count = 5'000'000'000}};

TEST(InputRecord, LiesOnTheChannelOfItsKindWithThePortBehindADot) {
  EXPECT_EQ(InputRecord(kFix).channel(), "EARSHOT_NAV_STATE.1");
  EXPECT_EQ(InputRecord(kMeasurement).channel(), "EARSHOT_SNR_ESTIMATE.0");
  EXPECT_EQ(InputRecord(kCommand).channel(), "EARSHOT_OPERATOR_COMMAND.7");
  EXPECT_EQ(InputRecord(kReport).channel(), "EARSHOT_PORT_REPORT.2");
  EXPECT_EQ(InputRecord(kBearing).channel(), "EARSHOT_BEARING.3");
  EXPECT_EQ(InputRecord(kVehicle).channel(), "EARSHOT_VEHICLE_STATUS.4");
  EXPECT_EQ(InputRecord(kAutopilot).channel(), "EARSHOT_AUTOPILOT_STATUS.5");
  EXPECT_EQ(InputRecord(kHydrophone).channel(), "EARSHOT_HYDROPHONE_STATUS.6");
  EXPECT_EQ(InputRecord(kUnsent).channel(), "EARSHOT_UNSENT_SETPOINTS.0");
}

TEST(InputRecord, IsReadBackAsTheInputThatItWas) {
  for (const Input& input : {kFix, kMeasurement, kCommand, kReport, kVehicle, kAutopilot, kHydrophone, kBearing, kUnsent}) {
    const InputRecord record(input);
    Input read;
    ASSERT_EQ(read_input(record.channel(), input.arrival, record.data(), input.sequence, read), Status::kOk) << record.channel();
    EXPECT_EQ(read.arrival, input.arrival);
    EXPECT_EQ(read.port, input.port);
    EXPECT_EQ(read.sequence, input.sequence);
    EXPECT_EQ(read.value, input.value) << record.channel();
  }
}

TEST(InputRecord, IsNoneOnAChannelOfAnotherKindOrPort) {
  const Encoded fix(std::get<messages::Navigation>(kFix.value));
  const auto read_from = [&fix](std::string_view channel) {
    Input input;
    return read_input(channel, Time{70}, fix.bytes(), 0, input);
  };
  EXPECT_EQ(read_from("EARSHOT_NAV_STATE.0"), Status::kOk);
  EXPECT_EQ(read_from("EARSHOT_NAV_STATE.7"), Status::kOk);
  for (const std::string_view channel : {"", "0", ".", ".0", "EARSHOT_NAV_STATE", "EARSHOT_NAV_STATE.", "EARSHOT_NAV_STATE.8",
                                         "EARSHOT_NAV_STATE./", "EARSHOT_NAV_STATE_0", "EARSHOT_NAV_STATE.00", "EARSHOT_HEALTH.0"})
    EXPECT_EQ(read_from(channel), Status::kUnsupported) << channel;
}

TEST(InputRecord, IsMalformedWhenItsBytesAreNotOfItsChannelsType) {
  const InputRecord fix(kFix);
  Input input;
  for (const std::string_view channel :
       {"EARSHOT_SNR_ESTIMATE.1", "EARSHOT_OPERATOR_COMMAND.1", "EARSHOT_PORT_REPORT.1", "EARSHOT_BEARING.1", "EARSHOT_UNSENT_SETPOINTS.1"})
    EXPECT_EQ(read_input(channel, Time{70}, fix.data(), 0, input), Status::kMalformed) << channel;
  EXPECT_EQ(read_input(fix.channel(), Time{70}, fix.data().first(fix.data().size() - 1), 0, input), Status::kMalformed);
  EXPECT_EQ(read_input(fix.channel(), Time{70}, {}, 0, input), Status::kMalformed);
}

}  // namespace
}  // namespace earshot::wire
