#include "policy/evaluate/output/figures_json.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/text/tells.hpp"

namespace earshot::evaluate {
namespace {

class FiguresJson : public testing::Test {
 protected:
  FiguresJson() {
    worlds_.push_back({.name = "paper", .what = "nothing differs", .seed = 7, .scenario = {}});
    row_.world = "paper";
    row_.policy = "oracle";
    row_.summary.mean_reward = -2.5;
    row_.decision_s = 3e-6;
  }
  [[nodiscard]] EvaluationSetup setup(std::optional<double> margin_m) const {
    return {.episodes = 300,
            .start_margin_m = margin_m,
            .start = "domain",
            .settings = settings_,
            .vehicle_depth = Meters{250.0},
            .trained_by = trained_by_,
            .warnings = warnings_,
            .worlds = worlds_,
            .tables = tables_};
  }

  search::SearchSettings settings_;
  std::vector<WorldFile> worlds_;
  std::string trained_by_;
  std::vector<std::string> warnings_;
  std::vector<std::optional<FlownTables>> tables_{std::nullopt};
  Row row_;
};

TEST_F(FiguresJson, NamesTheRegionOfTheStartsOrTheirMarginNeverBoth) {
  const auto by_region = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_EQ(by_region["start"], "domain");
  EXPECT_FALSE(by_region.contains("start_margin_m"));
  const auto by_margin = nlohmann::json::parse(as_json(setup(2'000.0), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_EQ(by_margin["start_margin_m"], 2'000.0);
  EXPECT_FALSE(by_margin.contains("start"));
}

TEST_F(FiguresJson, SaysWhoSaidThatTheSourceWasFoundAndHowOftenWrongly) {
  const auto told = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_EQ(told["found_by"], "simulator");
  EXPECT_FALSE(told["results"][0].contains("missed_fraction"));
  settings_.found_by = search::FoundBy::kSearcher;
  row_.declarations = DeclarationShares{.falsely = 0.25, .far_off = 0.125, .missed = 0.5};
  const auto at_sea = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_EQ(at_sea["found_by"], "searcher");
  EXPECT_EQ(at_sea["results"][0]["declared_falsely_fraction"], 0.25);
  EXPECT_EQ(at_sea["results"][0]["declared_far_off_fraction"], 0.125);
  EXPECT_EQ(at_sea["results"][0]["missed_fraction"], 0.5);
}

TEST_F(FiguresJson, SaysWhichTaskWasTestedWhoseItIsAndWhoWasTrainedForAnother) {
  const auto nobodys = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_TRUE(nobodys["trained_by"].is_null());
  EXPECT_EQ(nobodys["warnings"], nlohmann::json::array());
  EXPECT_EQ(nobodys["source"], "fixed");
  EXPECT_EQ(nobodys["source_north_m"], 10'000.0);
  trained_by_ = "a.policy";
  warnings_ = {"b.policy was trained 200 m deep and is tested 250 m deep"};
  settings_.placement = search::SourcePlacement::kChanging;
  const auto json = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_EQ(json["trained_by"], "a.policy");
  EXPECT_EQ(json["warnings"], nlohmann::json(warnings_));
  EXPECT_FALSE(json.contains("source_north_m"));
}

TEST_F(FiguresJson, SaysOfEveryWorldHowDeepItsVehicleIsAndByWhichTablesItSearches) {
  worlds_.push_back({.name = "shallow", .what = "60 m", .seed = 8, .vehicle_depth = Meters{30.0}, .scenario = {}});
  worlds_.push_back({.name = "other", .what = "100 m", .seed = 9, .vehicle_depth = Meters{50.0}, .scenario = {}});
  tables_.push_back(FlownTables{.file = "a.tables", .sha256 = "ab12", .count = 96, .signed_by = "cd34"});
  tables_.push_back(FlownTables{.file = "b.tables", .sha256 = "ab13", .count = 1, .signed_by = ""});
  const auto json = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_FALSE(json.contains("vehicle_depth_m")) << "there is no one depth";
  EXPECT_EQ(json["worlds"][0]["vehicle_depth_m"], 250.0);
  EXPECT_EQ(json["worlds"][0]["ocean_tables"], "own ocean");
  EXPECT_EQ(json["worlds"][1]["vehicle_depth_m"], 30.0);
  EXPECT_EQ(json["worlds"][1]["ocean_tables"],
            (nlohmann::json{{"file", "a.tables"}, {"sha256", "ab12"}, {"tables", 96}, {"signed_by", "cd34"}}));
  EXPECT_TRUE(json["worlds"][2]["ocean_tables"]["signed_by"].is_null());
}

TEST_F(FiguresJson, LeadsWithFoundThenTimeThenRewardAndHasNoNumberForATimeThatNeverComes) {
  row_.summary.found_fraction = 0.25;
  row_.found_fraction_95 = {0.1, 0.5};
  row_.time_to_find = {.lower_quartile = 36.0, .median = std::numeric_limits<double>::infinity(), .restricted_mean = 72.0};
  row_.pace.step_s = 100.0;
  const auto result = nlohmann::ordered_json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut))["results"][0];
  std::vector<std::string> names;
  for (const auto& [name, value] : result.items()) names.push_back(name);
  const auto place = [&](const char* name) { return std::ranges::find(names, name) - names.begin(); };
  EXPECT_EQ(place("found_fraction"), 3);
  EXPECT_LT(place("median_hours_to_find"), place("mean_reward"));
  EXPECT_EQ(result["found_fraction_95"], (nlohmann::ordered_json{0.1, 0.5}));
  EXPECT_EQ(result["lower_quartile_hours_to_find"], 1.0);
  EXPECT_EQ(result["lower_quartile_steps_to_find"], 36.0);
  EXPECT_TRUE(result["median_hours_to_find"].is_null());
  EXPECT_TRUE(result["median_steps_to_find"].is_null());
  EXPECT_EQ(result["restricted_mean_hours_to_find"], 2.0);
}

TEST_F(FiguresJson, HoldsTheTimeOfADecisionOnlyWhereItIsAskedFor) {
  const auto without = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_FALSE(without["results"][0].contains("decision_us"));
  EXPECT_EQ(without["results"][0]["mean_reward"], -2.5);
  EXPECT_EQ(without["worlds"][0]["seed"], 7);
  const auto with = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kIncluded));
  EXPECT_NEAR(with["results"][0]["decision_us"].get<double>(), 3.0, 1e-12);  // rounded once
}

TEST_F(FiguresJson, SaysInItsTitleWhatWasSearched) {
  EXPECT_TRUE(support::tells(title_of(setup(std::nullopt)), {"300", "searches", "source"}));
}

TEST_F(FiguresJson, OfASuiteAreThoseOfTheFileWithTheAreaAndTheSearches) {
  const auto suite = nlohmann::json::parse(as_suite(setup(std::nullopt), std::span(&row_, 1), SearchesJson{}));
  EXPECT_EQ(suite["figures"], nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut)));
  EXPECT_EQ(suite["area"], nlohmann::json::parse(R"({"south_m": 0.0, "west_m": 0.0, "north_m": 25000.0, "east_m": 25000.0})"));
  EXPECT_EQ(suite["title"], "300 searches each in paper, source fixed");
  EXPECT_EQ(suite["detection_threshold_db"], 10.0);
  EXPECT_TRUE(suite["searches"].is_array());
}

}  // namespace
}  // namespace earshot::evaluate
