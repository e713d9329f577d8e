#include "policy/evaluate/output/searches_json.hpp"

#include <gtest/gtest.h>

#include "policy/evaluate/evaluation.hpp"
#include "tests/policy/evaluate/eastward.hpp"

namespace earshot::evaluate {
namespace {

/// In two worlds that are one.
SearchesJson searches_in_the_east(std::size_t count) {
  const search::World world(lost_in_the_east(), kHeardNowhere);
  SearchesJson searches;
  GoesEast searcher;
  for (const char* name : {"calm", "rough"})
    (void)fly(searcher, world, {.end = count}, 1, [&](std::size_t number, const search::Episode& episode, search::EpisodeEnd end) {
      searches.add(name, "east", number, episode, end);
    });
  return searches;
}

TEST(SearchesJson, HoldsEverySearchWithItsStartAndTheEndOfEveryStep) {
  const SearchesJson searches = searches_in_the_east(1);
  ASSERT_EQ(searches.json().size(), 2U);
  const nlohmann::json expected = nlohmann::json::parse(R"({
    "world": "rough", "policy": "east", "number": 0, "end": "left_domain", "reward": -304.0,
    "source": {"north_m": 12000, "east_m": 2000},
    "north_m": [12000, 12000, 12000, 12000, 12000], "east_m": [22000, 23000, 24000, 25000, 26000],
    "snr_db": [-30.0, -30.0, -30.0, -30.0, -30.0]})");
  EXPECT_EQ(nlohmann::json(searches.json()[1]), expected) << searches.json()[1];
}

TEST(SearchesJson, KeepsTheFirstFiftyOfEachPolicyInEachWorld) {
  const SearchesJson searches = searches_in_the_east(60);
  ASSERT_EQ(searches.json().size(), 100U);
  EXPECT_EQ(searches.json()[49]["number"], 49);
  EXPECT_EQ(searches.json()[50]["world"], "rough");
  EXPECT_EQ(searches.json()[50]["number"], 0);
}

}  // namespace
}  // namespace earshot::evaluate
