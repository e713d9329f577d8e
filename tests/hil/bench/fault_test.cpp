#include "hil/bench/fault.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "tests/hil/seconds.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::hil {
namespace {

TEST(Fault, HasAWordOfItsOwnForEveryKindInTheOrderOfKinds) {
  std::set<std::string_view> words;
  for (const FaultTraits& traits : kFaultTraits) words.insert(traits.word);
  EXPECT_EQ(words.size(), kFaultTraits.size());
  const auto word_of = [](Fault fault) { return kFaultTraits.at(static_cast<std::size_t>(fault)).word; };
  EXPECT_EQ(word_of(Fault::kLoss), "loss");
  EXPECT_EQ(word_of(Fault::kReplay), "replay");
  EXPECT_EQ(word_of(Fault::kFlood), "flood");
  EXPECT_EQ(word_of(Fault::kWalkingNavigation), "walking_navigation");
  EXPECT_EQ(word_of(Fault::kPausingNavigation), "pausing_navigation");
  EXPECT_EQ(word_of(Fault::kRudderStuck), "rudder_stuck");
  EXPECT_EQ(word_of(Fault::kDepthStuck), "depth_stuck");
  EXPECT_EQ(word_of(Fault::kBusOff), "bus_off");
  EXPECT_EQ(word_of(Fault::kSoundShorted), "sound_shorted");
  EXPECT_EQ(word_of(Fault::kFullDisk), "full_disk");
  EXPECT_EQ(word_of(Fault::kNoRoom), "no_room");
  EXPECT_EQ(word_of(Fault::kOrder), "order");
}

TEST(Fault, IsNamedWhereNothingMakesIt) {
  EXPECT_STREQ(NoMaker(Fault::kReordering, "of frames on a CAN bus").what(),
               "the bench has nothing that makes the fault \"reordering\" of frames on a CAN bus");
}

TEST(Fault, ActsFromItsBeginningUntilBeforeItsEnd) {
  const TimedFault fault{.fault = Fault::kLeak, .from = at_s(100), .until = at_s(120)};
  EXPECT_FALSE(fault.acts_at(at_s(99)));
  EXPECT_TRUE(fault.acts_at(at_s(100)));
  EXPECT_TRUE(fault.acts_at(at_s(119)));
  EXPECT_FALSE(fault.acts_at(at_s(120)));
}

TEST(Fault, ActsToTheEndWithoutAnEnd) {
  const TimedFault fault{.fault = Fault::kLeak, .from = at_s(100)};
  EXPECT_TRUE(fault.acts_at(at_s(1'000'000)));
}

TEST(Fault, IsNewAtOneTickAlone) {
  const auto ticks = [](const TimedFault& fault) {
    std::vector<std::int64_t> found;
    for (std::int64_t s = 0; s < 10; ++s) {
      if (fault.is_new_at(at_s(s), Duration::seconds(1))) found.push_back(s);
    }
    return found;
  };
  EXPECT_EQ(ticks({.fault = Fault::kKill, .from = at_s(0)}), std::vector<std::int64_t>{0});
  EXPECT_EQ(ticks({.fault = Fault::kKill, .from = at_s(5)}), std::vector<std::int64_t>{5});
  EXPECT_EQ(ticks({.fault = Fault::kKill, .from = Time{5'500'000}}), std::vector<std::int64_t>{6}) << "it acts from then on";
}

TEST(Fault, HasAVectorClockwiseFromNorth) {
  const auto expect_vector = [](double direction_deg, double north, double east) {
    const TimedFault fault{.fault = Fault::kCurrent, .from = {}, .amount = 2.0, .direction_deg = direction_deg};
    EXPECT_NEAR(fault.vector().north.value, north, 1e-12) << direction_deg;
    EXPECT_NEAR(fault.vector().east.value, east, 1e-12) << direction_deg;
  };
  expect_vector(0.0, 2.0, 0.0);
  expect_vector(90.0, 0.0, 2.0);
  expect_vector(180.0, -2.0, 0.0);
  expect_vector(-90.0, 0.0, -2.0);
  expect_vector(30.0, 1.7320508075688772, 1.0);  // 2 cos 30 = sqrt 3
}

TEST(Fault, IsSaidInWordsWithWhoseFramesAndHowMany) {
  EXPECT_TRUE(support::tells(
      to_string({.fault = Fault::kLoss, .from = at_s(100), .until = at_s(120), .share = 0.5, .device = "compass", .pgn = 127250}),
      {"50 %", "127250", "100 s", "20 s"}));
  EXPECT_TRUE(support::tells(to_string({.fault = Fault::kNotAvailable, .from = at_s(5)}), {"not", "100 %", "5 s"}));
}

TEST(Fault, IsSaidInWordsWithItsAmountAndUnit) {
  EXPECT_TRUE(
      support::tells(to_string({.fault = Fault::kDelay, .from = at_s(1), .amount = 1.5, .share = 0.25}), {"1.5 seconds", "25 %", "1 s"}));
  EXPECT_EQ(to_string({.fault = Fault::kFlood, .from = at_s(30), .amount = 1900.0}), "flood 1900 frames per s from 30 s");
  EXPECT_EQ(to_string({.fault = Fault::kRudderStuck, .from = at_s(60), .until = at_s(90)}), "rudder stuck from 60 s for 30 s");
  EXPECT_TRUE(support::tells(to_string({.fault = Fault::kCurrent, .from = at_s(60), .amount = 0.4, .direction_deg = 270.0}),
                             {"0.4 m/s", "270 degrees", "60 s"}));
  EXPECT_EQ(to_string({.fault = Fault::kPowerCut, .from = at_s(100), .amount = 700.0}), "power cut 700 bytes at 100 s");
  EXPECT_EQ(to_string({.fault = Fault::kFullDisk, .from = at_s(0), .amount = 1'234'567.0}), "full disk 1234567 bytes from 0 s");
  EXPECT_EQ(to_string({.fault = Fault::kNetem, .from = at_s(60), .how = "loss 5%"}), "netem (loss 5%) from 60 s");
}

}  // namespace
}  // namespace earshot::hil
