// Missions at sea on buses that lose, double, reorder and corrupt what they carry, and that go down and come back: what their journals hold
// must give every output again, byte for byte. Over LCM, CAN and both; runs where vcan0 is (tests/outage/run).

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/core/random.hpp"
#include "tests/scenario/short_walk.hpp"
#include "tests/scenario/vehicle_over_lcm.hpp"
#include "tests/scenario/walk_at_sea.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
using messages::MissionState;

/// What a bus does to its messages, drawn from a seed.
class FaultyBus {
 public:
  FaultyBus(const std::string& interface, std::uint64_t seed) : interface_(interface) {
    Pcg32 random(seed);
    const auto percent = [&random](double most) { return std::to_string(most * random.uniform_double()) + "%"; };
    // No CAN bus changes the order of one sender's frames; and an order takes several, all of which must come through.
    const bool is_can = interface_ != "lo";
    const std::string faults = " loss " + percent(is_can ? 5.0 : 20.0) + " duplicate " + percent(10.0) + " corrupt " + percent(3.0);
    run("tc qdisc replace dev " + interface_ + " root netem" + faults + (is_can ? "" : " delay 1ms 1ms reorder " + percent(20.0)));
  }
  ~FaultyBus() {
    come_back();
    run("tc qdisc del dev " + interface_ + " root");
  }
  FaultyBus(const FaultyBus&) = delete;
  FaultyBus& operator=(const FaultyBus&) = delete;

  void go_down() const { run("ip link set " + interface_ + " down"); }
  void come_back() const {
    run("ip link set " + interface_ + " up");
    if (interface_ == "lo") run("ip route replace 224.0.0.0/4 dev lo");
  }

 private:
  static void run(const std::string& command) { EXPECT_EQ(std::system(command.c_str()), 0) << command; }
  std::string interface_;
};

void expect_given_again(const std::filesystem::path& journal) {
  for (int i = 0; i < 2; ++i) {
    const board::ReplayResult replayed = board::replay(journal);
    EXPECT_TRUE(replayed.is_same()) << "record " << (replayed.difference ? replayed.difference->record : replayed.gap.value_or(0));
    EXPECT_EQ(replayed.end, host::JournalReader::End::kWhole);
    EXPECT_GT(replayed.inputs, 100U);
    EXPECT_GT(replayed.decisions, 0U);
    if (i == 0) std::cout << replayed.inputs << " inputs, " << replayed.turns << " turns, " << replayed.decisions << " decisions\n";
  }
}

/// Goes down for a second when a quarter of the time at sea is over, if `is_cut`.
class Cut {
 public:
  Cut(const FaultyBus& bus, bool is_cut) : bus_(bus), is_cut_(is_cut) {}
  void turn() {
    const auto passed = std::chrono::steady_clock::now() - began_;
    if (is_cut_ && !is_down_ && passed > 5s) {
      bus_.go_down();
      is_down_ = true;
    } else if (is_down_ && is_cut_ && passed > 6s) {
      bus_.come_back();
      is_cut_ = false;
    }
  }

 private:
  const FaultyBus& bus_;
  bool is_cut_;
  bool is_down_ = false;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

class FaultyOverCan : public ShortWalk, public testing::WithParamInterface<int> {};

TEST_P(FaultyOverCan, GivenABusThatLosesAndSpoilsWhatItCarriesTheJournalGivesEveryByteAgain) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const FaultyBus bus("vcan0", seed);
  start_earshotd(walk_in("search_over_can_alone.toml"), policy());
  launch(in_the_middle());
  // An order may be lost as well.
  ASSERT_TRUE(sails_until([this] { return !taken_.empty(); }, 120s, [] {})) << earshotd_->output();
  Cut cut(bus, seed % 2 == 1);
  (void)sails_until([] { return false; }, 15s, [&cut] { cut.turn(); });
  earshotd_->signal(SIGTERM);
  ASSERT_NE(earshotd_->wait(20s), -1) << earshotd_->output();
  expect_given_again(folder_ / "journal.lcmlog");
}
INSTANTIATE_TEST_SUITE_P(Seven, FaultyOverCan, testing::Range(0, 7));

class FaultyMixed : public ShortWalk, public testing::WithParamInterface<int> {};

TEST_P(FaultyMixed, GivenTwoBusesThatLoseAndSpoilWhatTheyCarryTheJournalGivesEveryByteAgain) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const FaultyBus bus("vcan0", seed);
  const FaultyBus loopback("lo", seed + 1000);
  const std::string url = "udpm://239.255.76.67:27491?ttl=0";
  PayloadOverLcm payload(url);
  std::vector<std::string> arguments = policy();
  arguments.insert(arguments.end(), {"--lcm-url", url});
  start_earshotd(walk_in("search_over_can.toml"), arguments);
  hil::VehicleSetup setup = in_the_middle();
  setup.without = {"hydrophone", "operator"};
  launch(setup);
  ASSERT_TRUE(
      sails_until([&payload] { return payload.state() == MissionState::kSearch; }, 120s, [&payload] { payload.turn(Decibels{3.0}); }))
      << earshotd_->output();
  Cut cut(bus, seed % 2 == 1);
  (void)sails_until([] { return false; }, 15s,
                    [&] {
                      payload.turn(Decibels{3.0});
                      cut.turn();
                    });
  earshotd_->signal(SIGTERM);
  ASSERT_NE(earshotd_->wait(20s), -1) << earshotd_->output();
  expect_given_again(folder_ / "journal.lcmlog");
}
INSTANTIATE_TEST_SUITE_P(Seven, FaultyMixed, testing::Range(7, 14));

class FaultyOverLcm : public WalkAtSea, public testing::WithParamInterface<int> {};

TEST_P(FaultyOverLcm, GivenABusThatLosesAndSpoilsWhatItCarriesTheJournalGivesEveryByteAgain) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const FaultyBus loopback("lo", seed);
  std::string mission = mission_of_short_steps("search.toml");
  replace(mission, "navigation_timeout_s = 5.0", "navigation_timeout_s = 60.0");
  replace(mission, "snr_timeout_s = 5.0", "snr_timeout_s = 60.0");
  write_mission(mission);
  VehicleOverLcm vehicle{std::string(host::kDefaultLcmUrl)};
  start_earshotd({"--speed", "10"});
  ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.turns > 5; })) << earshotd_->output();
  // An order may be lost as well.
  for (int orders = 0; orders < 20 && vehicle.state() == MissionState::kStandby; ++orders) {
    vehicle.order(messages::Order::kStart);
    const int turns = vehicle.turns;
    ASSERT_TRUE(vehicle.sails_until([&] { return vehicle.turns > turns + 5; })) << earshotd_->output();
  }
  Cut cut(loopback, seed % 2 == 1);
  const auto until = std::chrono::steady_clock::now() + 15s;
  ASSERT_TRUE(vehicle.sails_until([&] {
    cut.turn();
    return std::chrono::steady_clock::now() > until;
  }));
  if (seed % 3 == 0) vehicle.order(messages::Order::kAbort);
  earshotd_->signal(SIGTERM);
  ASSERT_NE(earshotd_->wait(20s), -1) << earshotd_->output();
  expect_given_again(folder_ / "journal.lcmlog");
}
INSTANTIATE_TEST_SUITE_P(Six, FaultyOverLcm, testing::Range(14, 20));

}  // namespace
}  // namespace earshot
