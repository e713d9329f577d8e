// A search among several oceans.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "policy/baselines/bayes.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/search/scenario/world.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::baselines {
namespace {

constexpr Meters kDepth{300.0};
constexpr std::size_t kSearches = 10;
const std::filesystem::path kSource = EARSHOT_SOURCE_DIR;

search::SearchSettings anywhere() {
  search::SearchSettings settings;
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::inside_border(settings);
  return settings;
}

sonar::SnrCurve curve_of(const std::filesystem::path& environment) {
  return sonar::compute_snr_curve(ocean::load_environment(kSource / environment), kDepth, search::furthest_range(anywhere()));
}

/// The oceans of these worlds as tables.
policy::OceanTables tables_of(std::initializer_list<const char*> oceans) {
  policy::OceanTables tables;
  tables.range_count = 356;
  for (const char* name : oceans) {
    const sonar::SnrCurve curve = curve_of(std::filesystem::path("policy/worlds/oceans") / (std::string(name) + ".toml"));
    policy::OceanTable table;
    for (std::size_t i = 0; i < tables.range_count; ++i)
      table.snr_half_db[i] = policy::to_half_db(curve.at(static_cast<double>(i) * tables.range_step).value);
    EXPECT_EQ(tables.tables.push_back(table), Status::kOk);
  }
  return tables;
}

policy::OceanTables told(const sonar::SnrCurve& curve) {
  policy::OceanTables tables;
  search::make_known_ocean(anywhere(), curve, tables);
  return tables;
}

class OceanSearchTest : public testing::Test {
 protected:
  /// Told of the paper's ocean, which lies over mud.
  const sonar::SnrCurve mud = curve_of("sim/ocean/environments/munk_flat.toml");
  const search::SearchSettings settings = anywhere();
  const policy::OceanTables oceans = tables_of({"deep", "rock", "hard_bottom", "shallow"});
  const policy::OceanTables mud_alone = told(mud);
  const PriorKnowledge of_many{.settings = settings, .actions = search::compass_directions(8), .snr = mud, .oceans = oceans};
  const PriorKnowledge of_one{.settings = settings, .actions = search::compass_directions(8), .snr = mud, .oceans = mud_alone};

  [[nodiscard]] search::World world(const std::string& name) const {
    return search::assemble(evaluate::load_world(kSource / "policy/worlds" / (name + ".toml")).scenario, settings, kDepth);
  }

  static std::size_t found(Searcher& searcher, const search::World& world, std::size_t searches) {
    const std::vector<evaluate::Flight> flights = evaluate::fly(searcher, world, {.end = searches}, 1);
    return static_cast<std::size_t>(
        std::ranges::count(flights, search::EpisodeEnd::kFound, [](const evaluate::Flight& flight) { return flight.record.end; }));
  }
};

TEST_F(OceanSearchTest, FindsSourcesOverRockWhereABeliefInAnotherOceanFindsFew) {
  const search::World rock = world("rock");
  OceanSearch searcher(of_many);
  BayesLeastRegret knows_mud(of_one);
  EXPECT_GE(found(searcher, rock, kSearches), 9U);   // 40 of 40
  EXPECT_LE(found(knows_mud, rock, kSearches), 7U);  // 13 of 40
}

/// Told of one ocean it has that one louder or fainter, and more or less certain.
TEST_F(OceanSearchTest, FindsSourcesInShallowWaterThatItIsNotToldOfByTheFluctuationItAllows) {
  OceanSearch searcher(of_one);
  EXPECT_GE(found(searcher, world("shallow"), kSearches), 9U);  // 39 of 40
}

/// A vehicle that wavers between likely places that lie on every side goes over the same cells again and again.
TEST_F(OceanSearchTest, GoesOnInShallowWaterRatherThanWaver) {
  OceanSearch searcher(of_many);
  constexpr std::size_t kSteps = 20;
  std::vector<std::vector<NorthEast>> paths(kSearches);
  static_cast<void>(evaluate::fly(searcher, world("shallow"), {.end = kSearches}, 1,
                                  [&](std::size_t number, const search::Episode& episode, search::EpisodeEnd /*end*/) {
                                    if (paths[number].size() <= kSteps) paths[number].push_back(episode.position());
                                  }));
  std::size_t long_ones = 0;
  for (const std::vector<NorthEast>& path : paths) {
    if (path.size() <= kSteps) continue;
    ++long_ones;
    std::set<std::pair<int, int>> cells;  // of half a step
    for (const NorthEast place : path) cells.emplace(static_cast<int>(place.north.value / 500), static_cast<int>(place.east.value / 500));
    EXPECT_GE(cells.size(), 15U);  // 18 to 21
  }
  EXPECT_GE(long_ones, 3U);  // 24 of 40
}

/// Of what the belief is told in the first fifteen steps.
TEST_F(OceanSearchTest, HasAMismatchOverRockWhereItIsToldOfMudAloneAndNotInTheOceanOfWhichItIsTold) {
  search::SearchSettings brief = settings;
  brief.max_steps = 15;
  OceanSearch knows_mud(of_one);
  const auto mismatched = [&](const std::string& name) {
    const search::World sea = search::assemble(evaluate::load_world(kSource / "policy/worlds" / (name + ".toml")).scenario, brief, kDepth);
    return evaluate::mismatches(evaluate::fly(knows_mud, sea, {.end = 2 * kSearches}, 1)).fraction;
  };
  EXPECT_GE(mismatched("rock"), 0.8);   // 452 of 500
  EXPECT_EQ(mismatched("paper"), 0.0);  // 0 of 100
}

TEST_F(OceanSearchTest, SearchesTheSameWayAgain) {
  const search::World rock = world("rock");
  OceanSearch searcher(of_many);
  const auto once = evaluate::fly(searcher, rock, {.end = 3}, 5);
  const auto again = evaluate::fly(searcher, rock, {.end = 3}, 5);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].record.reward, again[i].record.reward);
    EXPECT_EQ(once[i].path_m, again[i].path_m);
  }
}

}  // namespace
}  // namespace earshot::baselines
