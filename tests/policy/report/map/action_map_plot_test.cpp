#include "policy/report/map/action_map_plot.hpp"

#include <gtest/gtest.h>

#include "tests/policy/explain/flown_policy.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

using explain::FlownPath;

class ActionMapPlot : public testing::Test {
 protected:
  void has(std::initializer_list<const char*> parts) const {
    const std::string svg = support::read_text(folder_ / "map.svg");
    for (const char* part : parts) EXPECT_NE(svg.find(part), std::string::npos) << part;
  }

  support::TemporaryFolder folder_;
  sonar::SnrCurve curve_{Meters{40'000.0}, {40.0F, 0.0F}};
  NorthEast source_{Meters{10'000.0}, Meters{10'000.0}};
};

TEST_F(ActionMapPlot, NamesThePolicyAndSaysWhatAnArrowIsBesideSnrOnTheScaleOfEveryField) {
  const auto policy = explain::place_policy(1);
  const MapOcean ocean{*policy, "fixed_source.policy", curve_, source_, "heard in a test", "source of 20 Hz", source_};
  draw_arrows(folder_ / "map.svg", ocean,
              explain::after_a_first_measurement(*policy, explain::falling_ocean(), 4, [](NorthEast) { return policy::Reception{}; }),
              "where it goes");
  has({"<title>What fixed_source.policy does: source of 20 Hz</title>", ">What fixed_source.policy does: source of 20 Hz<",
       ">heard in a test<", ">where it goes<", "Arrow: the mean of the directions, each weighted by its probability", ">-10<", "> 40<"});
}

/// One picture of the policy's area, with the corner in the mission's plane at `south_west`: what has been flown there looks the same.
TEST_F(ActionMapPlot, DrawsAFlightInTheAreasPlaneWhereverItsCornerIs) {
  const auto policy = explain::belief_policy(1);
  const MapOcean ocean{*policy, "shipped.policy", curve_, source_, "heard in a test", "source of 20 Hz", source_};
  const auto arrows =
      explain::after_a_first_measurement(*policy, explain::falling_ocean(), 4, [](NorthEast) { return policy::Reception{}; });
  const auto drawn_at = [&](NorthEast south_west) {
    const std::vector<explain::RecordedDecision> track = explain::flown(*policy, 3, south_west);
    explain::DecisionAccount account;
    account.area = {south_west, south_west + policy->area_size};
    account.place = {.area_size = policy->area_size,
                     .cells_north = 2,
                     .cells_east = 2,
                     .probability = {0.1, 0.2, 0.3, 0.4},
                     .rank = {1.0, 0.9, 0.7, 0.4},
                     .likeliest = {},
                     .mean = {},
                     .ellipse = {}};
    draw_arrows(folder_ / "map.svg", ocean, arrows, "where it goes", MapFlight{.belief = account, .track = track});
    return support::read_text(folder_ / "map.svg");
  };
  // Whole kilometres, of which the difference is exact.
  EXPECT_EQ(drawn_at({}), drawn_at({Meters{-4'000.0}, Meters{8'000.0}}));
}

TEST_F(ActionMapPlot, NamesThePolicyAndSaysHowManyPathsFindTheSource) {
  const auto policy = explain::belief_policy(1);
  const MapOcean ocean{*policy, "shipped.policy", curve_, source_, "heard in a test", "source of 20 Hz", source_};
  const std::vector<FlownPath> paths{{{{Meters{0.0}, Meters{0.0}}, {Meters{700.0}, Meters{700.0}}}, FlownPath::End::kFound}};
  draw_paths(folder_ / "map.svg", ocean, paths);
  has({">What shipped.policy does: source of 20 Hz<", "without random fluctuation of the SNR, by its best direction at every step",
       "The source is found from 1 of 1 starts, after 1 to 1 steps (median 1). Dot: a start; cross: one from which it is not found."});
}

TEST(PathsInWords, CountWhatBecameOfEachAndTheStepsOfThoseThatFind) {
  const auto path = [](std::size_t steps, FlownPath::End end) { return FlownPath{std::vector<NorthEast>(steps + 1), end}; };
  const std::vector<FlownPath> paths{path(9, FlownPath::End::kFound), path(3, FlownPath::End::kFound), path(4, FlownPath::End::kFound),
                                     path(2, FlownPath::End::kLeft), path(100, FlownPath::End::kStepLimit)};
  EXPECT_TRUE(support::tells(paths_to_string(paths), {"found", "3", "5 starts", "after 3 to 9 steps", "4", "1", "not found", "1"}));
}

}  // namespace
}  // namespace earshot::report
