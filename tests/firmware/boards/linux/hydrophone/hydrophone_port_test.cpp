#include "firmware/boards/linux/hydrophone/hydrophone_port.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <variant>

#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "firmware/boards/linux/host_mission_clock.hpp"
#include "firmware/boards/linux/lcm_port.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/hydrophone_driver.hpp"
#include "tests/support/private_network.hpp"

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

  static HydrophonePort hydrophone() {
    return {2, {.name = "ears", .kind = host::PortKind::kLcm, .address = kSoundUrl, .roles = {Role::kHydrophone}}, WakesFor::kLooks};
  }

  /// Sends until all that the driver's ADC took is reported, for half a minute at most.
  static void settle(support::HydrophoneDriver& driver, const HydrophonePort& port) {
    for (int i = 0; i < 600; ++i) {
      (void)driver.send();
      std::this_thread::sleep_for(50ms);
      if (port.report().received + port.report().lost == driver.taken()) return;
    }
    FAIL() << port.remark() << "; taken: " << driver.taken();
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
  EXPECT_EQ(port.remark(),
            "ears: of each channel " + std::to_string(driver.taken() - 137) +
                " samples heard, 137 lost (37 by the sender, 0 because the listener was slow); 5 clipped, 1 changes of gain, "
                "1 beginnings, 0 jumps that no ADC makes, 0 malformed messages, 0 datagrams overrun");
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
    ASSERT_EQ(bridge.publish(wire::kNavStateChannel, wire::Encoded(fix).bytes()), Status::kOk);
    ASSERT_EQ(bridge.publish(wire::kOperatorCommandChannel, wire::Encoded(abort).bytes()), Status::kOk);
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
