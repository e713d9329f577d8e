#include "hil/bench/results.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/hil/seconds.hpp"

namespace earshot::hil {
namespace {

using nlohmann::json;

class ResultsTest : public testing::Test {
 protected:
  ResultsTest() {
    mission_.operating_area = {.south_west = {}, .north_east = {Meters{100}, Meters{200}}};
    case_.name = "leak";
    case_.given = "a search";
    case_.when = "there is a leak";
    case_.then = "it ends";
    case_.defence = "its rule";
    case_.start = {Meters{1}, Meters{2}};
    case_.source = {Meters{3}, Meters{4}};
    case_.faults = {{.fault = Fault::kLeak, .from = at_s(60)}, {.fault = Fault::kFrozen, .from = at_s(10), .until = at_s(14)}};
    case_.expected = {.end = messages::EndReason::kSafetyRule,
                      .rules = {config::Condition::kLeak},
                      .refuses_commands = true,
                      .loses_nothing = true,
                      .decisions = 13,
                      .comes_up = true,
                      .releases_weight = true,
                      .refuses_frames = true,
                      .refuses_to_fly = true};
    flight_.last = at_s(63);
    flight_.wall_s = 1.5;
    flight_.sent = 7;
    flight_.received = 8;
    flight_.lost = 9;
    flight_.afflicted = 10;
    flight_.end = messages::EndReason::kSafetyRule;
    journal_.setpoints = 61;
    journal_.counters.navigation_refused = 11;
    journal_.counters.commands_refused = 12;
  }
  [[nodiscard]] json only() const {
    Results results;
    results.add(case_, mission_, flight_, journal_, {});
    return json::parse(results.text()).at("cases").at(0);
  }
  void trace(std::int64_t s, std::uint32_t identifier, bool from_earshot = false) {
    flight_.trace.push_back({.time = at_s(s), .from_earshot = from_earshot, .frame = {identifier, 2, {0x0A, 0xFF}}});
  }

  Case case_;
  config::Mission mission_;
  BenchFlight flight_;
  JournalFindings journal_;
};

TEST_F(ResultsTest, CountThoseWithWhichNothingIsWrong) {
  Results results;
  results.add(case_, mission_, flight_, journal_, {});
  results.add(case_, mission_, flight_, journal_, {"the rule leak did not fire"});
  EXPECT_EQ(results.passed(), 1U);
  const json cases = json::parse(results.text()).at("cases");
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0].at("passed"), true);
  EXPECT_EQ(cases[1].at("passed"), false);
  EXPECT_EQ(cases[1].at("wrong"), json::array({"the rule leak did not fire"}));
}

TEST_F(ResultsTest, SayTheCaseAndWhatCameOfIt) {
  const json found = only();
  EXPECT_EQ(found.at("name"), "leak");
  EXPECT_EQ(found.at("given"), "a search");
  EXPECT_EQ(found.at("when"), "there is a leak");
  EXPECT_EQ(found.at("then"), "it ends");
  EXPECT_EQ(found.at("defence"), "its rule");
  EXPECT_EQ(found.at("faults"), json::parse(R"([{"words": "leak from 60 s", "from_s": 60.0, "until_s": null},
                                                {"words": "frozen from 10 s for 4 s", "from_s": 10.0, "until_s": 14.0}])"));
  EXPECT_EQ(found.at("expected_end"), "a safety rule ended it");
  EXPECT_EQ(found.at("expected_rules"), json::array({"leak"}));
  EXPECT_EQ(found.at("others_may_fire"), false);
  EXPECT_EQ(found.at("refuses_navigation"), nullptr) << "as it comes";
  EXPECT_EQ(found.at("refuses_commands"), true);
  EXPECT_EQ(found.at("loses_nothing"), true);
  EXPECT_EQ(found.at("least_decisions"), 13);
  EXPECT_EQ(found.at("comes_up"), true);
  EXPECT_EQ(found.at("releases_weight"), true);
  EXPECT_EQ(found.at("refuses_frames"), true);
  EXPECT_EQ(found.at("refuses_to_fly"), true);
  EXPECT_EQ(found.at("bus"), "CAN");
  EXPECT_EQ(found.at("end"), "a safety rule ended it") << "as it was judged: a journal may have an end before it";
  EXPECT_EQ(found.at("setpoints"), 61);
  EXPECT_EQ(found.at("navigation_refused"), 11);
  EXPECT_EQ(found.at("commands_refused"), 12);
  EXPECT_EQ(found.at("at_sea_s"), 63.0);
  EXPECT_EQ(found.at("wall_s"), 1.5);
  EXPECT_EQ(found.at("frames_sent"), 7);
  EXPECT_EQ(found.at("frames_received"), 8);
  EXPECT_EQ(found.at("frames_lost_by_kernel"), 9);
  EXPECT_EQ(found.at("frames_afflicted"), 10);
  EXPECT_EQ(found.at("start_m"), json::array({1.0, 2.0}));
  EXPECT_EQ(found.at("source_m"), json::array({3.0, 4.0}));
}

TEST_F(ResultsTest, LetAFaultThatIsDoneOnceActForATick) {
  case_.faults = {{.fault = Fault::kKill, .from = at_s(50)}};
  EXPECT_EQ(only().at("faults"), json::parse(R"([{"words": "kill at 50 s", "from_s": 50.0, "until_s": 51.0}])"));
}

TEST_F(ResultsTest, SayTheRulesThatFiredWithTheirMeasures) {
  journal_.events = {{.time = at_s(62),
                      .condition = config::Condition::kDepth,
                      .response = config::Response::kSurface,
                      .begins = true,
                      .measure = 401.5,
                      .limit = 400.0}};
  EXPECT_EQ(only().at("events"), json::parse(R"([{"time_s": 62.0, "rule": "depth_m", "begins": true, "response": "surface",
                                                  "measure": 401.5, "limit": 400.0}])"));
}

TEST_F(ResultsTest, HaveTheAreaForAHaltPolygonWhereThereIsNoFence) {
  EXPECT_EQ(only().at("halt_polygon_m"), json::parse("[[0.0, 0.0], [100.0, 0.0], [100.0, 200.0], [0.0, 200.0]]"));
  config::Fence fence;
  for (const NorthEast& corner : {NorthEast{Meters{-1}, Meters{0}}, NorthEast{Meters{5}, Meters{0}}, NorthEast{Meters{5}, Meters{5}}})
    (void)fence.halt.push_back(corner);
  mission_.safety.fence = fence;
  EXPECT_EQ(only().at("halt_polygon_m"), json::parse("[[-1.0, 0.0], [5.0, 0.0], [5.0, 5.0]]"));
}

TEST_F(ResultsTest, ThinALongTrackToFiveHundredPlacesAndFewer) {
  for (std::int64_t s = 0; s < 1200; ++s)
    flight_.track.push_back({.time = at_s(s), .position = {Meters{static_cast<double>(s)}, Meters{7}}, .depth = Meters{300}});
  const json track = only().at("track");
  ASSERT_EQ(track.size(), 400U) << "every third";
  EXPECT_EQ(track[1], json::array({3.0, 3.0, 7.0, 300.0}));
}

TEST_F(ResultsTest, ShowTheBusAroundTheFirstRuleThatFired) {
  for (std::int64_t s = 0; s < 200; ++s) trace(s, 0x09F11224, s == 100);
  journal_.events = {{.time = at_s(100), .begins = false}, {.time = at_s(100), .begins = true}, {.time = at_s(150), .begins = true}};
  const json frames = only().at("trace");
  ASSERT_EQ(frames.size(), 8U) << "5 s before it to 2 s behind it";
  EXPECT_EQ(frames[0].at("time_s"), 95.0);
  EXPECT_EQ(frames[7].at("time_s"), 102.0);
  EXPECT_EQ(frames[5], json::parse(R"({"time_s": 100.0, "from_earshot": true, "pgn": 127250, "source": 36, "data": "0aff"})"));
}

TEST_F(ResultsTest, ShowTheLastOfTheBusWhereNoRuleFired) {
  for (std::int64_t s = 0; s < 200; ++s) trace(s, 0x09F11224);
  EXPECT_EQ(only().at("trace").front().at("time_s"), 194.0);
  EXPECT_EQ(only().at("trace").back().at("time_s"), 199.0);
  flight_.trace.clear();
  EXPECT_EQ(only().at("trace"), json::array());
}

TEST_F(ResultsTest, ShowNoMoreThanFourHundredFramesOfAFloodedBus) {
  for (int i = 0; i < 1000; ++i) trace(100, 0);
  for (int i = 0; i < 1000; ++i) trace(101, 0);
  journal_.events = {{.time = at_s(100), .begins = true}};
  const json frames = only().at("trace");
  ASSERT_EQ(frames.size(), 400U);
  EXPECT_EQ(frames[299].at("time_s"), 100.0);
  EXPECT_EQ(frames[300].at("time_s"), 101.0);
}

}  // namespace
}  // namespace earshot::hil
