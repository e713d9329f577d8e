#include "firmware/boards/linux/lcm_port.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "earshot/bearing_t.hpp"
#include "earshot/command_acknowledgement_t.hpp"
#include "earshot/decision_t.hpp"
#include "earshot/detection_t.hpp"
#include "earshot/health_t.hpp"
#include "earshot/safety_event_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using host::Role;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";

/// Counts what the loop would be given.
class CountingSink final : public InputSink {
 public:
  void take(std::uint8_t /*port*/, const Value& value) override {
    if (std::holds_alternative<messages::SnrMeasurement>(value)) ++snrs;
    if (std::holds_alternative<messages::BearingMeasurement>(value)) ++bearings;
  }
  int snrs = 0;
  int bearings = 0;
};

class LcmPortTest : public testing::Test {
 protected:
  void SetUp() override { ENTER_PRIVATE_NETWORK_OR_SKIP(); }

  static LcmPort port(bool snr_is_simulators) {
    return {1, {.name = "vehicle", .address = kUrl, .roles = {Role::kNavigation, Role::kSnr}, .snr_is_simulators = snr_is_simulators}};
  }
  /// Two SNRs and three bearings, of whoever is on the bus.
  static void send() {
    host::LcmEndpoint sender(host::parse_lcm_url(kUrl), {});
    for (int i = 0; i < 2; ++i) (void)sender.publish(wire::kSnrEstimateChannel, support::bytes_of(snr_estimate_t{}));
    for (int i = 0; i < 3; ++i) (void)sender.publish(wire::kBearingChannel, support::bytes_of(bearing_t{}));
  }
};

TEST_F(LcmPortTest, GivenASimulatorThatTellsTheSnrIgnoresThatOfStrangersAndSaysSo) {
  LcmPort vehicle = port(true);
  SetClock clock;
  CountingSink sink;
  send();
  vehicle.collect(clock, sink);
  EXPECT_EQ(sink.snrs, 0);
  EXPECT_EQ(sink.bearings, 0);
  EXPECT_EQ(vehicle.report().received, 0U) << "what stands in the journal is the flight's alone";
  EXPECT_EQ(vehicle.report().malformed, 0U);
  EXPECT_TRUE(support::tells(vehicle.words().strangers, {"LCM", "udpm://239.255.76.67:7667?ttl=0", "2 SNRs", "3 bearings", "ignored"}));
}

template <class Message>
void send_input(host::LcmEndpoint& sender) {
  (void)sender.publish(wire::channel_of<Message>, wire::Encoded(Message{}, Time{}).bytes());
}

/// How many of the kinds of input, one message each, a port of one role takes.
std::uint64_t taken_as(Role role) {
  LcmPort vehicle(1, {.name = "vehicle", .address = kUrl, .roles = {role}});
  host::LcmEndpoint sender(host::parse_lcm_url(kUrl), {});
  send_input<messages::Navigation>(sender);
  send_input<messages::VehicleStatus>(sender);
  send_input<messages::SnrMeasurement>(sender);
  send_input<messages::BearingMeasurement>(sender);
  send_input<messages::HydrophoneStatus>(sender);
  send_input<messages::OperatorCommand>(sender);
  send_input<messages::AutopilotStatus>(sender);
  SetClock clock;
  CountingSink sink;
  vehicle.collect(clock, sink);
  return vehicle.report().received + vehicle.report().malformed;
}

TEST_F(LcmPortTest, TakesThoseKindsOfInputThatItsRolesBring) {
  EXPECT_EQ(taken_as(Role::kNavigation), 2U) << "where the vehicle is, and how it is";
  EXPECT_EQ(taken_as(Role::kSnr), 3U) << "SNR, bearing, whether the hydrophone is deaf";
  EXPECT_EQ(taken_as(Role::kOperator), 1U);
  EXPECT_EQ(taken_as(Role::kAutopilot), 1U);
  EXPECT_EQ(taken_as(Role::kStatus), 0U);
}

/// Mission time an hour ahead of the wall's.
class HourAhead final : public SetClock {
 public:
  [[nodiscard]] Time utc_of(Time mission_time) override { return mission_time + Duration::seconds(-3600); }
};

template <class Message>
std::int64_t utime_of(const wire::Lc02Message& message) {
  Message value{};
  EXPECT_EQ(support::read_peer(message.data, value), Status::kOk) << message.channel;
  return value.utime;
}

TEST_F(LcmPortTest, DatesAllThatItSaysByTheWallClock) {
  LcmPort vehicle(1, {.name = "vehicle", .address = kUrl, .roles = {Role::kAutopilot, Role::kOperator, Role::kStatus}});
  host::LcmEndpoint ashore(host::parse_lcm_url(kUrl), {wire::kSetpointChannel, wire::kAcknowledgementChannel, wire::kDecisionChannel,
                                                       wire::kSafetyEventChannel, wire::kHealthChannel, wire::kDetectionChannel});
  HourAhead clock;
  CountingSink sink;
  vehicle.collect(clock, sink);
  const Time now{1'795'000'000'000'000};
  runtime::Outputs outputs;
  outputs.setpoint.emplace();
  outputs.decision.emplace();
  outputs.decision->time = now;
  ASSERT_EQ(outputs.acknowledgements.push_back({.time = now, .port = 1}), Status::kOk);
  ASSERT_EQ(outputs.safety_events.push_back({.time = now}), Status::kOk);
  vehicle.publish(now, outputs);
  messages::SoundDetection detection;
  detection.begin = now;
  vehicle.publish_detection(detection);
  ashore.collect();
  std::map<std::string, std::int64_t> dates;
  for (wire::Lc02Message m; ashore.take(m) == Status::kOk;) {
    const std::string channel(m.channel);
    dates[channel] = channel == wire::kSetpointChannel          ? utime_of<setpoint_t>(m)
                     : channel == wire::kAcknowledgementChannel ? utime_of<command_acknowledgement_t>(m)
                     : channel == wire::kDecisionChannel        ? utime_of<decision_t>(m)
                     : channel == wire::kSafetyEventChannel     ? utime_of<safety_event_t>(m)
                     : channel == wire::kHealthChannel          ? utime_of<health_t>(m)
                                                                : utime_of<detection_t>(m);
  }
  EXPECT_EQ(dates.size(), 6U) << "every message that bears a date";
  for (const auto& [channel, utime] : dates) EXPECT_EQ(utime, now.us - 3'600'000'000) << channel;
}

TEST_F(LcmPortTest, TakesEverySnrAndBearingWhereNoSimulatorTellsThem) {
  LcmPort vehicle = port(false);
  SetClock clock;
  CountingSink sink;
  send();
  vehicle.collect(clock, sink);
  EXPECT_EQ(sink.snrs, 2);
  EXPECT_EQ(sink.bearings, 3);
  EXPECT_EQ(vehicle.report().received, 5U);
  EXPECT_EQ(vehicle.words().strangers, "");
}

}  // namespace
}  // namespace earshot::board
