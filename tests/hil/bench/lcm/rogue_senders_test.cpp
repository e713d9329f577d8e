#include "hil/bench/lcm/rogue_senders.hpp"

#include <gtest/gtest.h>

#include <set>

#include "earshot/nav_state_t.hpp"
#include "earshot/operator_command_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/hil/seconds.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::hil {
namespace {

template <class Type>
Type read(const LcmMessage& message) {
  Type value{};
  EXPECT_EQ(support::read_peer(message.data, value), Status::kOk);
  return value;
}

/// Beside a vehicle 1 km north of the origin, in 300 m; one fault, from 10 s on.
class RogueSendersTest : public testing::Test {
 protected:
  RogueSendersTest() { faults_.at(0).from = at_s(10); }
  LcmMessages step(Time now) {
    LcmMessages sent;
    rogue_nodes_.step(now, sent);
    return sent;
  }
  void let(Fault fault, double amount = 0.0) {
    faults_.at(0).fault = fault;
    faults_.at(0).amount = amount;
  }
  std::vector<TimedFault> faults_{TimedFault{}};
  const vehicle::State vehicle_{.position = {Meters{1000}, Meters{0}}, .depth = Meters{300}, .heading = {}, .speed = MetersPerSecond{2}};
  RogueSenders rogue_nodes_{faults_, vehicle_, 1};
};

TEST_F(RogueSendersTest, SayNothingBeforeTheirTime) {
  let(Fault::kStrangersOrder);
  EXPECT_TRUE(step(at_s(9)).empty());
  EXPECT_EQ(step(at_s(10)).size(), 1U);
}

TEST_F(RogueSendersTest, FloodAChannelOfTheirOwnWithSoManyMessagesASecond) {
  let(Fault::kFlood, 2.5);
  (void)step(at_s(9));
  EXPECT_EQ(step(at_s(10)).size(), 2U);
  const LcmMessages sent = step(at_s(11));
  EXPECT_EQ(sent.size(), 3U) << "five in two seconds";
  EXPECT_EQ(sent.at(0).channel, "SOMEBODY_ELSES_CAMERA");
}

TEST_F(RogueSendersTest, DrawFixesThatAreDatedNow) {
  let(Fault::kNavigationFlood, 3.0);
  (void)step(at_s(9));
  const LcmMessages sent = step(at_s(10));
  ASSERT_EQ(sent.size(), 3U);
  std::set<std::vector<std::uint8_t>> different;
  for (const LcmMessage& message : sent) {
    EXPECT_EQ(message.channel, wire::kNavStateChannel);
    EXPECT_EQ(read<nav_state_t>(message).utime, 10'000'000);
    different.insert(message.data);
  }
  EXPECT_EQ(different.size(), 3U);
}

TEST_F(RogueSendersTest, BelieveThatTheVehicleIsElsewhere) {
  let(Fault::kSecondNavigation, 500.0);
  faults_.at(0).direction_deg = 90.0;
  const auto fix = read<nav_state_t>(step(at_s(10)).at(0));
  EXPECT_NEAR(fix.north_m, 1000.0, 1e-9);
  EXPECT_NEAR(fix.east_m, 500.0, 1e-9);
  EXPECT_EQ(fix.depth_m, 300.0);
}

TEST_F(RogueSendersTest, GiveAnOrderThatHasExpiredAndEveryTimeAnotherNumber) {
  let(Fault::kStrangersOrder);
  (void)step(at_s(29));
  const auto order = read<operator_command_t>(step(at_s(30)).at(0));
  EXPECT_TRUE(order.command == operator_command_t::COMPLETE);
  EXPECT_EQ(order.utime, 10'000'000);
  EXPECT_EQ(order.expiry_utime, 11'000'000);
  EXPECT_EQ(order.number, 2);
}

TEST_F(RogueSendersTest, GiveAnAbortOfWhichNoMoreThanTheHeadIsThere) {
  let(Fault::kCutAbort);
  const LcmMessages sent = step(at_s(10));
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].data.size(), 33U) << "8 of the fingerprint, 8 and 8 of dates, 4 and 4 of numbers, 1 of the order";
  EXPECT_TRUE(sent[0].data.back() == operator_command_t::ABORT);
}

TEST_F(RogueSendersTest, GiveAPauseWhoseMarkIsOfTheKeyButOfNoChallenge) {
  let(Fault::kRecordedOrder);
  const messages::OperatorCommand order = support::from_peer<messages::OperatorCommand>(read<operator_command_t>(step(at_s(10)).at(0)));
  EXPECT_EQ(order.order, messages::Order::kPause);
  EXPECT_EQ(order.time, at_s(10));
  EXPECT_TRUE(bench_key().verifies_old(order));
  EXPECT_FALSE(bench_key().verifies(order, messages::Challenge{}));
}

TEST_F(RogueSendersTest, SaySomethingForEveryFaultOfAnLcmBus) {
  for (const FaultTraits& traits : kFaultTraits) {
    const std::vector<TimedFault> faults{{.fault = traits.fault, .from = at_s(1), .amount = traits.lowest}};
    RogueSenders senders(faults, vehicle_, 1);
    LcmMessages sent;
    const auto send = [&] {
      for (const int s : {0, 1}) senders.step(at_s(s), sent);
    };
    if (traits.hits == FaultTarget::kBus && traits.bus == FaultBus::kCan) {
      EXPECT_THROW(send(), NoMaker) << traits.word;
    } else {
      EXPECT_NO_THROW(send()) << traits.word;
      EXPECT_EQ(!sent.empty(), traits.hits == FaultTarget::kBus) << traits.word;
    }
  }
}

TEST_F(RogueSendersTest, GiveAnOrderThatThereIsNoneOf) {
  let(Fault::kUnknownOrder);
  const auto order = read<operator_command_t>(step(at_s(10)).at(0));
  EXPECT_EQ(order.utime, 10'000'000);
  EXPECT_EQ(order.command, 99);
}

}  // namespace
}  // namespace earshot::hil
