#include "hil/bench/can/rogue_nodes.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/node/identity.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"
#include "tests/hil/seconds.hpp"

namespace earshot::hil {
namespace {

class RogueNodesTest : public testing::Test {
 protected:
  /// What they say in each second up to `until`, told the time once a second.
  [[nodiscard]] std::vector<Frames> seconds_of(const std::vector<TimedFault>& faults, std::int64_t until) const {
    RogueNodes rogue_nodes(faults, vehicle_, plane_);
    std::vector<Frames> seconds;
    for (std::int64_t s = 0; s < until; ++s) {
      Frames frames;
      rogue_nodes.step(at_s(s), frames);
      seconds.push_back(frames);
    }
    return seconds;
  }

  vehicle::State vehicle_{
      .position = {Meters{500}, Meters{0}}, .depth = Meters{300}, .heading = Radians{0.5}, .speed = MetersPerSecond{2.0}};
  const n2k::LocalPlane plane_;  ///< about 0 N, 0 E
};

TEST_F(RogueNodesTest, SayNothingWhereNobodyIntrudes) {
  for (const Frames& frames : seconds_of({{.fault = Fault::kLeak, .from = at_s(0)}, {.fault = Fault::kLoss, .from = at_s(0)}}, 10))
    EXPECT_TRUE(frames.empty());
}

TEST_F(RogueNodesTest, AreThereOnlyAsLongAsTheirFaultActs) {
  for (const TimedFault& fault : {TimedFault{.fault = Fault::kFlood, .from = at_s(5), .until = at_s(8), .amount = 10},
                                  TimedFault{.fault = Fault::kStrangersOrder, .from = at_s(5), .until = at_s(8)},
                                  TimedFault{.fault = Fault::kSecondNavigation, .from = at_s(5), .until = at_s(8), .amount = 10},
                                  TimedFault{.fault = Fault::kSecondAutopilot, .from = at_s(5), .until = at_s(8)},
                                  TimedFault{.fault = Fault::kAddressThief, .from = at_s(5), .until = at_s(8)}}) {
    const std::vector<Frames> seconds = seconds_of({fault}, 12);
    for (const std::size_t s : {0, 1, 2, 3, 4, 8, 9, 10, 11}) EXPECT_TRUE(seconds[s].empty()) << s << " " << to_string(fault);
    EXPECT_FALSE(seconds[5].empty()) << to_string(fault);
  }
}

TEST_F(RogueNodesTest, MakeEveryFaultOfTheBusThatACaseInLockStepMayName) {
  for (const FaultTraits& traits : kFaultTraits) {
    if (traits.flight == FaultFlight::kAtSea) continue;
    const std::vector<TimedFault> faults{{.fault = traits.fault, .from = at_s(0), .amount = traits.lowest}};
    if (traits.hits == FaultTarget::kBus && traits.bus == FaultBus::kLcm) {
      EXPECT_THROW((void)seconds_of(faults, 2), NoMaker) << traits.word;
    } else {
      EXPECT_NO_THROW((void)seconds_of(faults, 2)) << traits.word;
    }
  }
}

TEST_F(RogueNodesTest, FloodTheBusWithFramesThatWinEveryArbitrationAndBearACounter) {
  const std::vector<Frames> seconds = seconds_of({{.fault = Fault::kFlood, .from = at_s(1), .amount = 300}}, 3);
  ASSERT_EQ(seconds[1].size(), 300U);
  ASSERT_EQ(seconds[2].size(), 300U);
  EXPECT_EQ(seconds[1][0], (n2k::Frame{0, 8, {0, 0, 0, 0, 0, 0, 0, 0}}));
  EXPECT_EQ(seconds[2][0], (n2k::Frame{0, 8, {44, 1, 0, 0, 0, 0, 0, 0}})) << "300 = 0x012C";
}

/// A flood's frame has 131 bits and up to 20 stuff bits, 147.2 in the mean of the counter's first 440,000 (counted bit by bit, with its
/// CRC, by a program of its own): 250,000 bits a second are 1,699 of them.
TEST_F(RogueNodesTest, FillTheBusFromSoManyFramesOnAsItHasBitsForWhileTheyFlood) {
  const TimedFault most{.fault = Fault::kFlood, .from = at_s(5), .until = at_s(8), .amount = 1'550};
  const TimedFault rest{.fault = Fault::kFlood, .from = at_s(6), .amount = 150};
  const RogueNodes one({most}, vehicle_, plane_);
  const RogueNodes both({most, rest}, vehicle_, plane_);
  for (std::int64_t s = 0; s < 10; ++s) {
    EXPECT_FALSE(one.fill_bus(at_s(s))) << s;
    EXPECT_EQ(both.fill_bus(at_s(s)), s == 6 || s == 7) << s;
  }
}

TEST_F(RogueNodesTest, OweWhatIsLessThanAFrameToTheNextSecond) {
  const std::vector<Frames> seconds = seconds_of({{.fault = Fault::kFlood, .from = at_s(1), .amount = 1.5}}, 5);
  EXPECT_EQ(seconds[1].size(), 1U);
  EXPECT_EQ(seconds[2].size(), 2U);
  EXPECT_EQ(seconds[3].size(), 1U);
  EXPECT_EQ(seconds[4].size(), 2U);
}

TEST_F(RogueNodesTest, GiveAnOutdatedCompleteOnceASecondToEarshot) {
  const std::vector<Frames> seconds = seconds_of({{.fault = Fault::kStrangersOrder, .from = at_s(30)}}, 33);
  n2k::OrderReceiver receiver;
  for (std::uint32_t s = 30; s < 33; ++s) {
    messages::OperatorCommand order;
    std::uint8_t sender = 0;
    Status status = Status::kNotReady;
    for (const n2k::Frame& frame : seconds[s]) status = receiver.accept(frame, at_s(s), n2k::kRuntimeAddress, order, sender);
    ASSERT_EQ(status, Status::kOk);
    EXPECT_EQ(order.order, messages::Order::kComplete);
    EXPECT_EQ(order.time, at_s(s - 20));
    EXPECT_EQ(order.expiry, at_s(s - 19)) << "long ago";
    EXPECT_EQ(order.number, s - 29) << "a new one each time";
    EXPECT_EQ(sender, 0x7A);
  }
}

TEST_F(RogueNodesTest, ClaimEarshotsAddressWithMoreRights) {
  const std::vector<Frames> seconds = seconds_of({{.fault = Fault::kAddressThief, .from = at_s(2)}}, 4);
  const Frames claims = of_group(n2k::kAddressClaimPgn, seconds[2]);
  ASSERT_EQ(claims.size(), 1U);
  EXPECT_EQ(claims[0].identifier, 0x18EEFF40U);
  std::uint64_t name = 0;
  for (unsigned i = 0; i < 8; ++i) name |= std::uint64_t{claims[0].data[i]} << (8 * i);
  EXPECT_LT(name, n2k::name_of({.unique_number = 0}).value()) << "the lowest of any Earshot's: the lower wins";
}

TEST_F(RogueNodesTest, GiveWayToWhoHasMoreRightsThanTheyHave) {
  RogueNodes rogue_nodes({{.fault = Fault::kAddressThief, .from = at_s(0)}}, vehicle_, plane_);
  (void)run(rogue_nodes, at_s(0), at_s(1));
  rogue_nodes.accept({.identifier = 0x18EEFF40, .size = 8, .data = {}}, at_s(1));
  const Frames claims = of_group(n2k::kAddressClaimPgn, run(rogue_nodes, at_s(1), at_s(2)));
  ASSERT_FALSE(claims.empty());
  EXPECT_NE(claims.back().identifier & 0xFFU, 0x40U);
}

TEST_F(RogueNodesTest, NavigateBesideTheVehicleAndWithIt) {
  RogueNodes rogue_nodes({{.fault = Fault::kSecondNavigation, .from = at_s(0), .amount = 500, .direction_deg = 90}}, vehicle_, plane_);
  (void)run(rogue_nodes, at_s(0), at_s(1));
  vehicle_.position.north = Meters{1000};
  vehicle_.heading = Radians{1.25};
  const Frames said = run(rogue_nodes, at_s(1), at_s(2));
  const Frames positions = of_group(n2k::kPositionPgn, said);
  ASSERT_EQ(positions.size(), 10U);
  // On the ellipsoid's meridian at the equator 1000 m are 0.0090437 degrees (radius 6335439 m); on the equator 500 m 0.0044916 (6378137 m).
  EXPECT_NEAR(n2k::read(n2k::kPositionPgn, "Latitude", positions.back().bytes()).value(), 0.0090437, 1e-7);
  EXPECT_NEAR(n2k::read(n2k::kPositionPgn, "Longitude", positions.back().bytes()).value(), 0.0044916, 1e-7);
  EXPECT_NEAR(n2k::read(n2k::kCoursePgn, "COG", of_group(n2k::kCoursePgn, said).back().bytes()).value(), 1.25, 0.6e-4);
}

TEST_F(RogueNodesTest, AreAnAutopilotThatSaysOfNoSetPointThatItFollowsIt) {
  RogueNodes rogue_nodes({{.fault = Fault::kSecondAutopilot, .from = at_s(0)}}, vehicle_, plane_);
  (void)run(rogue_nodes, at_s(0), at_s(1));
  n2k::SetpointFrames frames;
  ASSERT_EQ(n2k::compose_setpoint({.heading = {}, .speed = {}, .depth = Meters{100}, .waypoint = {}}, 0x40, 1, frames), Status::kOk);
  for (const n2k::Frame& frame : frames) rogue_nodes.accept(frame, at_s(1));
  const Frames said = of_group(n2k::kAutopilotStatusPgn, run(rogue_nodes, at_s(1), at_s(2)));
  ASSERT_EQ(said.size(), 1U);
  const n2k::AutopilotCondition condition = n2k::read_autopilot_status(said[0].bytes()).value();
  EXPECT_FALSE(condition.follows_setpoints);
}

TEST_F(RogueNodesTest, HaveNumbersThatNoDeviceOfTheVehicleHas) {
  const std::vector<Frames> seconds =
      seconds_of({{.fault = Fault::kSecondAutopilot, .from = at_s(0)}, {.fault = Fault::kAddressThief, .from = at_s(0)}}, 1);
  const Frames claims = of_group(n2k::kAddressClaimPgn, seconds[0]);
  ASSERT_EQ(claims.size(), 2U);
  // 0x1FFF80 and 0x1FFF81 in the lower 21 bits.
  EXPECT_EQ(claims[0].data[0], 0x80);
  EXPECT_EQ(claims[1].data[0], 0x81);
  for (const n2k::Frame& claim : claims) {
    EXPECT_EQ(claim.data[1], 0xFF);
    EXPECT_EQ(claim.data[2] & 0x1F, 0x1F);
  }
}

}  // namespace
}  // namespace earshot::hil
