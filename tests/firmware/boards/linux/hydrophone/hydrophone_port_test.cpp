#include "firmware/boards/linux/hydrophone/hydrophone_port.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "firmware/boards/linux/clock/host_mission_clock.hpp"
#include "firmware/boards/linux/lcm_port.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/gaussian_noise.hpp"
#include "tests/support/hydrophone_driver.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

using namespace std::chrono_literals;
using host::Role;

constexpr const char* kVehicleUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr const char* kSoundUrl = "udpm://239.255.76.67:7668?ttl=0";

/// Counts what the loop would be given.
class CountingSink final : public InputSink {
 public:
  void take(std::uint8_t /*port*/, const Value& value) override {
    if (std::holds_alternative<messages::Navigation>(value)) ++fixes;
    const auto* command = std::get_if<messages::OperatorCommand>(&value);
    if (command != nullptr && command->order == messages::Order::kAbort) ++aborts;
  }
  std::uint64_t fixes = 0;
  std::uint64_t aborts = 0;
};

class HydrophonePortTest : public testing::Test {
 protected:
  void SetUp() override { ENTER_PRIVATE_NETWORK_OR_SKIP(); }

  static HydrophonePort hydrophone(const std::optional<detector::SoundSettings>& hearing = std::nullopt) {
    return {2,
            {.name = "ears", .kind = host::PortKind::kLcm, .address = kSoundUrl, .roles = {Role::kHydrophone}},
            hearing,
            WakesFor::kMeasurements};
  }

  /// Sends until all that the driver's ADC took is reported, for half a minute at most.
  static void settle(support::HydrophoneDriver& driver, const HydrophonePort& port) {
    for (int i = 0; i < 600; ++i) {
      (void)driver.send();
      std::this_thread::sleep_for(50ms);
      if (port.report().received + port.report().lost == driver.taken()) return;
    }
    FAIL() << port.words().remark << "; taken: " << driver.taken();
  }
};

TEST_F(HydrophonePortTest, ReportsSamplesOfOneChannelAndSaysWhereTheyWereLost) {
  const HydrophonePort port = hydrophone();
  support::HydrophoneDriver driver(kSoundUrl, {.sample_rate_hz = 1000, .channels = 2, .samples_per_block = 100});
  ASSERT_TRUE(driver.send());
  driver.lose_block();
  driver.block().gain_db = 26;
  driver.block().overflow_count = 5;
  ASSERT_TRUE(driver.send());
  driver.block().overflow_count = 0;
  driver.lose_samples(37);
  settle(driver, port);
  EXPECT_EQ(port.report().port, 2);
  EXPECT_EQ(port.report().lost, 137U);
  EXPECT_TRUE(port.report().link_up);
  EXPECT_TRUE(support::tells(port.words().remark,
                             {"ears", "channel", std::to_string(driver.taken() - 137), "heard", "137", "lost", "37", "0 because", "5",
                              "clipped", "1", "changes", "1 beginnings", "0 jumps", "no ADC", "0 malformed", "0 datagrams"}));
}

/// Keeps what the loop would be given.
class KeepingSink final : public InputSink {
 public:
  void take(std::uint8_t port, const Value& value) override {
    EXPECT_EQ(port, 2);
    if (const auto* measurement = std::get_if<messages::SnrMeasurement>(&value)) measurements.push_back(*measurement);
  }
  void report_chain(std::uint8_t /*port*/, const HeardChain& chain) override { chains.push_back(chain); }
  std::vector<messages::SnrMeasurement> measurements;
  std::vector<HeardChain> chains;
};

/// A mission clock that is an hour ahead of the blocks' dates, and takes sound when it is told to.
class HourAhead final : public Clock {
 public:
  static constexpr Duration kHour = Duration::seconds(3600);
  [[nodiscard]] Time now() override { return {}; }
  [[nodiscard]] Time mission_time_of(Time utc) override { return utc + kHour; }
  [[nodiscard]] Time arrival_of(Time utc) override { return utc; }
  [[nodiscard]] bool takes_sound_now() const override { return takes_sound; }
  [[nodiscard]] Wake wait(const Awaited& /*awaited*/) override { return Wake::kNothing; }
  [[nodiscard]] bool answered(const runtime::Outputs& /*outputs*/, std::uint64_t /*setpoints_sent*/) override { return true; }
  bool takes_sound = false;
};

TEST_F(HydrophonePortTest, BringsTheLoopMeasurementsDatedOnTheMissionClockWhenThatTakesThem) {
  detector::SoundSettings hearing;
  hearing.floor_window = Duration::seconds(32);  // known after 8 s
  HydrophonePort port = hydrophone(hearing);
  support::HydrophoneDriver driver(kSoundUrl, {.sample_rate_hz = 250, .channels = 1, .samples_per_block = 250});
  support::GaussianNoise noise(3);
  const std::int64_t began_us = driver.block().utime;
  for (std::uint64_t block = 1; block <= 20; ++block) {
    for (float& sample : driver.block().samples) sample = 0.01F * noise();
    ASSERT_TRUE(driver.send());
    for (int i = 0; i < 3000 && port.blocks_heard() < block; ++i) std::this_thread::sleep_for(10ms);
    ASSERT_EQ(port.blocks_heard(), block);
  }
  HourAhead clock;
  KeepingSink sink;
  port.collect(clock, sink);
  EXPECT_TRUE(sink.measurements.empty());
  EXPECT_TRUE(sink.chains.empty());
  clock.takes_sound = true;
  port.collect(clock, sink);
  ASSERT_GE(sink.measurements.size(), 5U);
  ASSERT_EQ(sink.chains.size(), 1U);
  EXPECT_LE(sink.measurements.back().time, (Time{began_us} + HourAhead::kHour + Duration::seconds(20)));
  EXPECT_GE(sink.measurements.back().time, (Time{began_us} + HourAhead::kHour + Duration::seconds(18)));
  EXPECT_NE(port.words().remark.find("of 20 s of sound: " + std::to_string(sink.measurements.size()) + " SNR measurements"),
            std::string::npos)
      << port.words().remark;
}

TEST_F(HydrophonePortTest, LetsNoFixAndNoAbortOfTheLoopBeLostOrWaitThoughTwoHundredThousandBlocksPass) {
  const HydrophonePort sound = hydrophone();
  LcmPort vehicle(1,
                  {.name = "vehicle", .kind = host::PortKind::kLcm, .address = kVehicleUrl, .roles = {Role::kNavigation, Role::kOperator}});
  const HostClock host;
  HostMissionClock clock(host, 1.0);
  CountingSink sink;
  host::LcmEndpoint bridge(host::parse_lcm_url(kVehicleUrl), {});
  support::HydrophoneDriver driver(kSoundUrl, {.channels = 1, .samples_per_block = 16});
  constexpr std::uint64_t kTurns = 200;
  constexpr std::uint64_t kBlocksPerTurn = 1000;
  nav_state_t fix{};
  operator_command_t abort{};
  abort.command = operator_command_t::ABORT;
  for (std::uint64_t turn = 1; turn <= kTurns; ++turn) {
    ASSERT_EQ(bridge.publish(wire::kNavStateChannel, support::bytes_of(fix)), Status::kOk);
    ASSERT_EQ(bridge.publish(wire::kOperatorCommandChannel, support::bytes_of(abort)), Status::kOk);
    for (std::uint64_t i = 0; i < kBlocksPerTurn; ++i) (void)driver.send();
    vehicle.collect(clock, sink);
    ASSERT_EQ(sink.fixes, turn) << "in this turn, not in a later one";
    ASSERT_EQ(sink.aborts, turn);
  }
  EXPECT_EQ(vehicle.report().lost, 0U);
  settle(driver, sound);
  EXPECT_GE(driver.taken(), kTurns * kBlocksPerTurn * 16);
}

}  // namespace
}  // namespace earshot::board
