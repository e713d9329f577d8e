#include "firmware/runtime/search_agent.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>

#include "tests/firmware/runtime/mission_rig.hpp"

namespace earshot::runtime {
namespace {

/// An agent that stands 12 km north and 11 km east of its area's corner, and hears 3 dB.
std::unique_ptr<SearchAgent> started(const policy::FrozenPolicy& policy) {
  auto agent = std::make_unique<SearchAgent>();
  EXPECT_EQ(agent->load(paper_mission(), *frozen(policy), *paper_oceans()), Status::kOk);
  agent->start(paper_mission(), at(7000, 12000), {.snr = Decibels{3}});
  return agent;
}

/// The first place of a value in its memory changes by a bit.
template <class Value>
void flip_in(SearchAgent& agent, const Value& value) {
  const std::span bytes(reinterpret_cast<unsigned char*>(&agent), sizeof(SearchAgent));
  const std::span of_value(reinterpret_cast<const unsigned char*>(&value), sizeof value);
  const auto place = std::search(bytes.begin(), bytes.end(), of_value.begin(), of_value.end());
  ASSERT_NE(place, bytes.end());
  *place = static_cast<unsigned char>(*place ^ 4U);
}

TEST(SearchAgent, IsIntactAfterEachOfItsCalls) {
  const auto agent = started(*policy_that_believes());
  EXPECT_TRUE(agent->is_intact());
  agent->remember(paper_mission(), at(8000, 12000), {.snr = Decibels{4}});
  EXPECT_TRUE(agent->is_intact());
  (void)agent->refine();
  EXPECT_TRUE(agent->is_intact());
}

TEST(SearchAgent, IsNotIntactWithABitFlippedInPolicyOrTablesOrMemory) {
  const auto policy = policy_that_believes();
  policy->network.layer(0).bias[3] = 0.123456F;
  const auto in_policy = started(*policy);
  flip_in(*in_policy, 0.123456F);
  EXPECT_FALSE(in_policy->is_intact());

  const auto tables = paper_oceans();
  tables->tables[1].prior = 0.123456F;
  const auto in_tables = std::make_unique<SearchAgent>();
  ASSERT_EQ(in_tables->load(paper_mission(), *frozen(*policy_that_believes()), *tables), Status::kOk);
  in_tables->start(paper_mission(), at(7000, 12000), {.snr = Decibels{3}});
  ASSERT_TRUE(in_tables->is_intact());
  flip_in(*in_tables, 0.123456F);
  EXPECT_FALSE(in_tables->is_intact());

  const auto in_memory = started(*policy_that_believes());
  messages::Decision decision;
  ASSERT_TRUE(in_memory->observe(paper_mission(), decision));
  flip_in(*in_memory, decision.belief->spread);
  EXPECT_FALSE(in_memory->is_intact());
}

/// Its place east and north in an area of 25 km, of which the middle is 0 and the edge 1.
TEST(SearchAgent, ObservesFromTheCornerOfTheArea) {
  const auto agent = started(*policy_that_goes(kEastward));
  messages::Decision decision;
  ASSERT_TRUE(agent->observe(paper_mission(), decision));
  ASSERT_EQ(decision.observation_size, 2U);
  EXPECT_EQ(decision.action_count, 4U);
  EXPECT_NEAR(decision.observation[0], 2.0 * 11.0 / 25.0 - 1.0, 1e-6) << "of a float";
  EXPECT_NEAR(decision.observation[1], 2.0 * 12.0 / 25.0 - 1.0, 1e-6);
  EXPECT_FALSE(decision.belief);
  EXPECT_EQ(agent->mismatch_bits(), 0.0F);
  EXPECT_FALSE(agent->has_found());
}

/// 1e30 m from the corner: no element of a policy that was checked is so great.
TEST(SearchAgent, ObservesNothingBeyondWhatAPolicyMaySee) {
  const auto agent = started(*policy_that_goes(kEastward));
  agent->start(paper_mission(), at(1e30, 0), {.snr = Decibels{3}});
  messages::Decision decision;
  EXPECT_FALSE(agent->observe(paper_mission(), decision));
}

TEST(SearchAgent, ChoosesThePolicysActionAndLeavesTheSeedOfOneThatDrawsNone) {
  const auto agent = started(*policy_that_goes(kSouthward));
  messages::Decision decision;
  ASSERT_TRUE(agent->observe(paper_mission(), decision));
  Pcg32 random(5);
  Pcg32 same(5);
  guidance::Fallback fallback;
  const std::size_t action = agent->choose(paper_mission(), decision, at(7000, 12000), random, fallback);
  EXPECT_EQ(action, kSouthward);
  EXPECT_EQ(agent->direction_of(action).north, -1.0);
  EXPECT_FALSE(fallback.is_sweeping());
  EXPECT_EQ(random.uniform_float(), same.uniform_float());
}

/// The area's corner lies 5 km south and 1 km east of the origin, and the area is 25 km wide.
TEST(SearchAgent, TellsItsBeliefInTheMissionsPlane) {
  const auto agent = started(*policy_that_believes());
  messages::Decision decision;
  ASSERT_TRUE(agent->observe(paper_mission(), decision));
  ASSERT_TRUE(decision.belief);
  config::Mission moved = paper_mission();
  moved.operating_area = {.south_west = at(95'000, 1000), .north_east = at(120'000, 26'000)};
  messages::Decision elsewhere;
  ASSERT_TRUE(agent->observe(moved, elsewhere));
  EXPECT_EQ(elsewhere.belief->likeliest - decision.belief->likeliest, at(100'000, 0));
  EXPECT_NEAR((elsewhere.belief->mean - decision.belief->mean).north.value, 100'000, 1e-6) << "of rounding";
  EXPECT_TRUE(paper_mission().operating_area.contains(decision.belief->likeliest));
}

TEST(SearchAgent, RefusesAPolicyOfAnotherMissionAndOneThatThisBuildDoesNotRepeat) {
  const auto agent = std::make_unique<SearchAgent>();
  const auto policy = frozen(*policy_that_goes(kNorthward));
  config::Mission longer = paper_mission();
  longer.step_length = Meters{2000};
  EXPECT_EQ(agent->load(longer, *policy, *paper_oceans()), Status::kOutOfRange);
  policy->network.layer(2).bias[1] += 1.0F;
  EXPECT_EQ(agent->load(paper_mission(), *policy, *paper_oceans()), Status::kCorrupt);
}

}  // namespace
}  // namespace earshot::runtime
