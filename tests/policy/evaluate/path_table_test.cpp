#include "policy/evaluate/output/path_table.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "policy/evaluate/evaluation.hpp"
#include "tests/policy/evaluate/eastward.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::evaluate {
namespace {

TEST(PathTable, HoldsTheStartAndTheEndOfEveryStepInOrder) {
  GoesEast searcher;
  const search::World world(lost_in_the_east(), kHeardNowhere);
  PathTable table;
  const auto watch = [&](std::size_t number, const search::Episode& episode, search::EpisodeEnd end) {
    table.add("calm", "east", number, episode, end);
  };
  const std::vector<Flight> flights = fly(searcher, world, {.end = 1}, 1, watch);
  ASSERT_EQ(flights.size(), 1U);
  EXPECT_TRUE(support::lines_tell(table.csv(),
                                  {{"world,policy,episode,step,north_m,east_m,snr_db,reward_so_far,source_north_m,source_east_m,state"},
                                   {"calm,east,0,0,12000,22000,-30,0,12000,2000,running"},
                                   {"calm,east,0,1,12000,23000,-30,-1,12000,2000,running"},
                                   {"calm,east,0,2,12000,24000,-30,-2,12000,2000,running"},
                                   {"calm,east,0,3,12000,25000,-30,-103,12000,2000,running"},
                                   {"calm,east,0,4,12000,26000,-30,-304,12000,2000,left_domain"}}));
}

TEST(PathTable, KeepsNamesWithCommasAndQuotesInTheirCells) {
  GoesEast searcher;
  const search::World world(lost_in_the_east(), kHeardNowhere);
  PathTable table;
  (void)fly(searcher, world, {.end = 1}, 1, [&](std::size_t number, const search::Episode& episode, search::EpisodeEnd end) {
    table.add("deep, cold", R"(a"b)", number, episode, end);
  });
  EXPECT_NE(table.csv().find("\n\"deep, cold\",\"a\"\"b\",0,0,12000,22000,"), std::string::npos) << table.csv();
}

TEST(PathTable, WatchingChangesNothing) {
  GoesEast searcher;
  search::SearchSettings settings;
  settings.placement = search::SourcePlacement::kChanging;
  const search::World world(settings, kHeardNowhere);
  std::size_t shown = 0;
  const std::vector<Flight> watched =
      fly(searcher, world, {.end = 20}, 7, [&](std::size_t, const search::Episode&, search::EpisodeEnd) { ++shown; });
  const std::vector<Flight> unwatched = fly(searcher, world, {.end = 20}, 7);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < watched.size(); ++i) {
    EXPECT_EQ(watched[i].record.reward, unwatched[i].record.reward);
    expected += 1 + unwatched[i].record.steps;
  }
  EXPECT_EQ(shown, expected);
}

/// Goes east, and says after its second step that it is there.
class DeclaresAtTwo : public GoesEast {
 public:
  void begin(Pcg32) override { measurements_ = 0; }
  std::size_t choose(const baselines::DecisionInput& input) override {
    ++measurements_;
    return GoesEast::choose(input);
  }
  [[nodiscard]] std::optional<bool> declares_found() const override { return measurements_ == 3; }

 private:
  int measurements_ = 0;
};

TEST(PathTable, EndsInFoundWhereASearcherDeclaresItAndNobodyElseSaysSo) {
  DeclaresAtTwo searcher;
  search::SearchSettings settings = lost_in_the_east();
  settings.source = {Meters{12'000.0}, Meters{24'500.0}};
  settings.found_by = search::FoundBy::kSearcher;
  const search::World world(settings, kHeardNowhere);
  PathTable table;
  (void)fly(searcher, world, {.end = 1}, 1, [&](std::size_t number, const search::Episode& episode, search::EpisodeEnd end) {
    table.add("calm", "east", number, episode, end);
  });
  EXPECT_NE(table.csv().find("calm,east,0,1,12000,23000,-30,-1,12000,24500,running\ncalm,east,0,2,12000,24000,"), std::string::npos)
      << table.csv();
  EXPECT_TRUE(table.csv().ends_with(",12000,24500,found\n")) << table.csv();
}

}  // namespace
}  // namespace earshot::evaluate
