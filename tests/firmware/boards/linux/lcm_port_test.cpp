#include "firmware/boards/linux/lcm_port.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "earshot/bearing_t.hpp"
#include "earshot/snr_estimate_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/support/private_network.hpp"

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

/// A simulator's, which has sent so many bearings.
class BearingClock final : public SetClock {
 public:
  explicit BearingClock(int sent) : left_(sent) {}
  [[nodiscard]] bool takes_bearing(Time /*utc*/) override { return left_-- > 0; }

 private:
  int left_;
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
    for (int i = 0; i < 2; ++i) (void)sender.publish(wire::kSnrEstimateChannel, wire::Encoded(snr_estimate_t{}).bytes());
    for (int i = 0; i < 3; ++i) (void)sender.publish(wire::kBearingChannel, wire::Encoded(bearing_t{}).bytes());
  }
};

TEST_F(LcmPortTest, GivenASimulatorThatTellsTheSnrIgnoresThatOfStrangersAndSaysSo) {
  LcmPort vehicle = port(true);
  BearingClock clock(1);
  CountingSink sink;
  send();
  vehicle.collect(clock, sink);
  EXPECT_EQ(sink.snrs, 0);
  EXPECT_EQ(sink.bearings, 1) << "the one that the simulator sent";
  EXPECT_EQ(vehicle.report().received, 1U) << "what stands in the journal is the flight's alone";
  EXPECT_EQ(vehicle.report().malformed, 0U);
  EXPECT_EQ(vehicle.strangers(),
            "vehicle, LCM udpm://239.255.76.67:7667?ttl=0: 2 SNRs and 2 bearings of somebody else on this bus were ignored: in simulation "
            "they come from the simulator alone");
}

TEST_F(LcmPortTest, TakesEverySnrAndBearingWhereNoSimulatorTellsThem) {
  LcmPort vehicle = port(false);
  BearingClock clock(0);
  CountingSink sink;
  send();
  vehicle.collect(clock, sink);
  EXPECT_EQ(sink.snrs, 2);
  EXPECT_EQ(sink.bearings, 3);
  EXPECT_EQ(vehicle.report().received, 5U);
  EXPECT_EQ(vehicle.strangers(), "");
}

}  // namespace
}  // namespace earshot::board
