#include "policy/evaluate/figures_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

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
    return {.episodes = 300, .start_margin_m = margin_m, .start = "domain", .settings = settings_, .worlds = worlds_};
  }

  search::SearchSettings settings_;
  std::vector<WorldFile> worlds_;
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

TEST_F(FiguresJson, HoldsTheTimeOfADecisionOnlyWhereItIsAskedFor) {
  const auto without = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kLeftOut));
  EXPECT_FALSE(without["results"][0].contains("decision_us"));
  EXPECT_EQ(without["results"][0]["mean_reward"], -2.5);
  EXPECT_EQ(without["worlds"][0]["seed"], 7);
  const auto with = nlohmann::json::parse(as_json(setup(std::nullopt), std::span(&row_, 1), Timing::kIncluded));
  EXPECT_NEAR(with["results"][0]["decision_us"].get<double>(), 3.0, 1e-12);  // rounded once
}

TEST_F(FiguresJson, SaysInItsTitleWhatWasSearched) {
  EXPECT_EQ(title_of(setup(std::nullopt)), "300 searches each in paper, source fixed");
}

}  // namespace
}  // namespace earshot::evaluate
