#include "hil/bench/random_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

#include "tests/hil/seconds.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hil {
namespace {

Case case_of(std::vector<TimedFault> faults) {
  return {.name = "some",
          .given = "a search",
          .when = "something fails",
          .then = "it goes on",
          .mission = EARSHOT_SOURCE_DIR "/hil/missions/search_over_can.toml",
          .start = {Meters{12'500}, Meters{11'000}},
          .source = {Meters{12'500}, Meters{12'500}},
          .at_most = Duration::seconds(3600),
          .faults = std::move(faults),
          .expected = {}};
}

/// Five faults, one with an end, one of a case of its own.
std::vector<Case> pool() {
  return {case_of({{.fault = Fault::kLeak, .from = at_s(60)},
                   {.fault = Fault::kLoss, .from = at_s(100), .until = at_s(130), .share = 0.5, .device = "compass", .pgn = 127250},
                   {.fault = Fault::kKill, .from = at_s(40)},
                   {.fault = Fault::kFrozen, .from = at_s(40)}}),
          case_of({}), case_of({{.fault = Fault::kCurrent, .from = at_s(10), .amount = 0.3, .direction_deg = 90.0}})};
}

TEST(RandomCase, IsTheSameWithTheSameSeedAndAnotherWithAnother) {
  EXPECT_EQ(random_case(pool(), 4711), random_case(pool(), 4711));
  EXPECT_NE(random_case(pool(), 4711), random_case(pool(), 4712));
  EXPECT_EQ(random_case(pool(), 4711).name, "random_4711");
}

TEST(RandomCase, HasTwoOrThreeFaultsOfThePoolEachAtATimeOfItsOwn) {
  std::set<std::size_t> counts;
  std::set<Fault> kinds;
  std::set<double> towards_deg;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Case c = random_case(pool(), seed);
    counts.insert(c.faults.size());
    for (const TimedFault& fault : c.faults) {
      kinds.insert(fault.fault);
      EXPECT_GE(fault.from, at_s(1));
      EXPECT_LT(fault.from, at_s(201));
      EXPECT_EQ(fault.until.has_value(), fault.fault == Fault::kLoss);
      if (fault.fault == Fault::kCurrent) towards_deg.insert(fault.direction_deg);
      if (fault.fault != Fault::kLoss) continue;
      EXPECT_EQ((*fault.until - fault.from).us, 30'000'000) << "it lasts as long as in the pool";
      EXPECT_EQ(fault.device, "compass");
      EXPECT_EQ(fault.share, 0.5);
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{2, 3}));
  EXPECT_GT(towards_deg.size(), 10U) << "each has its own";
  EXPECT_EQ(kinds, (std::set<Fault>{Fault::kLeak, Fault::kLoss, Fault::kKill, Fault::kFrozen, Fault::kCurrent}));
}

TEST(RandomCase, BeginsNearTheSouthernEdgeTowardsItAndHasTheSourceBeyondIt) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Case c = random_case(pool(), seed);
    EXPECT_GE(c.start.north.value, 0.0);
    EXPECT_LT(c.start.north.value, 300.0);
    EXPECT_GE(c.start.east.value, 5'000.0);
    EXPECT_LT(c.start.east.value, 20'000.0);
    EXPECT_GE(c.start_heading_deg, 90.0);
    EXPECT_LT(c.start_heading_deg, 270.0);
    EXPECT_NEAR((c.source - c.start).north.value, -3'000.0, 1e-9);
    EXPECT_EQ(c.at_most, Duration::seconds(400));
  }
}

TEST(Shrunk, TakesOutEveryFaultWithoutWhichTheCaseStillFails) {
  const Case whole = pool().front();
  int flights = 0;
  const auto has = [](const Case& c, Fault kind) { return std::ranges::count(c.faults, kind, &TimedFault::fault) > 0; };
  const Case small = shrunk(whole, [&](const Case& tried) {
    ++flights;
    return has(tried, Fault::kLoss) && has(tried, Fault::kFrozen);
  });
  ASSERT_EQ(small.faults.size(), 2U);
  EXPECT_EQ(small.faults[0], whole.faults[1]);
  EXPECT_EQ(small.faults[1], whole.faults[3]);
  EXPECT_EQ(flights, 4) << "each fault is left out once";
}

TEST(Shrunk, KeepsTheLastFault) {
  const Case small = shrunk(pool().front(), [](const Case&) { return true; });
  ASSERT_EQ(small.faults.size(), 1U);
  EXPECT_EQ(small.faults[0].fault, Fault::kFrozen);
}

TEST(Shrunk, KeepsThemAllWhereEachIsNeeded) {
  const Case whole = pool().front();
  EXPECT_EQ(shrunk(whole, [](const Case&) { return false; }), whole);
}

TEST(ToToml, IsReadAsTheSameCaseAgain) {
  const support::TemporaryFolder folder;
  const auto read_again = [&folder](const Case& c) {
    std::ofstream(folder / (c.name + ".toml")) << to_toml(c);
    return load_case(folder / (c.name + ".toml"), c.mission);
  };
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Case c = random_case(pool(), seed);
    EXPECT_EQ(read_again(c), c) << to_toml(c);
  }
  Case full = case_of({{.fault = Fault::kPositionError, .from = Time{1'500'001}, .amount = -1234.5678901234567, .direction_deg = -33.25},
                       {.fault = Fault::kFullDisk, .from = at_s(0), .amount = 1e12}});
  full.given = "a \"search\" with a \\";
  full.defence = "a \"rule\"";
  full.expected = {.end = messages::EndReason::kSafetyRule,
                   .rules = {config::Condition::kLeak, config::Condition::kNavigationAge},
                   .only_these = false,
                   .refuses_navigation = true,
                   .refuses_commands = false,
                   .loses_nothing = true,
                   .decisions = 2,
                   .comes_up = true,
                   .releases_weight = true};
  EXPECT_EQ(read_again(full), full) << to_toml(full);
}

TEST(ToToml, NamesAMissionThatIsFoundFromAnyFolder) {
  Case c = case_of({});
  c.mission = "here/../missions/search.toml";
  EXPECT_NE(to_toml(c).find("mission = \"" + (std::filesystem::current_path() / "missions/search.toml").string() + "\"\n"),
            std::string::npos);
}

}  // namespace
}  // namespace earshot::hil
