#include "policy/tables/merge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace earshot::tables {
namespace {

OceanCurve curve(const std::string& name, double weight, std::vector<double> snr_db) {
  return {.name = name,
          .detail = "",
          .weight = weight,
          .sea_depth = Meters{100.0 * weight},
          .source_depth = Meters{30.0},
          .snr_db = std::move(snr_db)};
}

std::string names(const std::vector<OceanCurve>& curves) {
  std::string all;
  for (const OceanCurve& c : curves) all += c.name;
  return all;
}

TEST(Difference, IsTheRootMeanSquareWhereOneOfTheTwoIsAudible) {
  const std::vector<double> a{20.0, 10.0, -30.0, -30.0};
  const std::vector<double> b{17.0, 14.0, -90.0, 5.0};
  EXPECT_DOUBLE_EQ(difference_db(a, b), std::sqrt((9.0 + 16.0 + 25.0) / 3.0));  // 5 dB of the last are audible, not 35
  EXPECT_DOUBLE_EQ(difference_db(b, a), difference_db(a, b));
}

TEST(Difference, IsNoneOfWhatNobodyHears) {
  EXPECT_EQ(difference_db(std::vector<double>{-1.0, 0.0}, std::vector<double>{-50.0, -70.0}), 0.0);
}

TEST(Merge, LeavesWhatIsFewEnoughAsItIs) {
  const std::vector<OceanCurve> curves{curve("a", 1, {10, 20}), curve("b", 1, {10, 20}), curve("c", 1, {30, 20})};
  const Merged merged = merge(curves, 3);
  EXPECT_EQ(names(merged.curves), "abc");
  EXPECT_EQ(merged.most_difference_db, 0.0);
}

TEST(Merge, PutsTheTwoTogetherThatAreMostAlike) {
  const Merged merged = merge({curve("a", 1, {10, 20}), curve("b", 1, {40, 20}), curve("c", 3, {12, 20})}, 2);
  ASSERT_EQ(names(merged.curves), "cb");
  EXPECT_EQ(merged.curves[0].weight, 4.0);
  EXPECT_EQ(merged.curves[0].sea_depth, Meters{300.0});                     // of the heavier
  EXPECT_EQ(merged.curves[0].snr_db, (std::vector<double>{11.5, 20}));      // (1 x 10 + 3 x 12) / 4
  EXPECT_DOUBLE_EQ(merged.most_difference_db, std::sqrt(1.5 * 1.5 / 2.0));  // a's from it
}

TEST(Merge, RatherMovesALightCurveThanAHeavyOne) {
  // Ward: of two pairs that are 2 dB apart, 1 x 1 / 2 and 10 x 10 / 20.
  const Merged merged = merge({curve("a", 10, {10}), curve("b", 10, {12}), curve("c", 1, {40}), curve("d", 1, {42})}, 3);
  EXPECT_EQ(names(merged.curves), "abc");
}

TEST(Merge, GoesOnWithWhatItHasMerged) {
  const Merged merged = merge({curve("a", 1, {10}), curve("b", 1, {11}), curve("c", 1, {13}), curve("d", 1, {50})}, 2);
  ASSERT_EQ(names(merged.curves), "ad");
  EXPECT_DOUBLE_EQ(merged.curves[0].snr_db[0], (10.0 + 11.0 + 13.0) / 3.0);
  EXPECT_DOUBLE_EQ(merged.most_difference_db, 13.0 - (10.0 + 11.0 + 13.0) / 3.0);
}

TEST(Merge, TakesTheFirstOfEqualPairsAndTheFirstNameOfEqualWeights) {
  const Merged merged = merge({curve("a", 1, {10}), curve("b", 1, {20}), curve("c", 1, {10}), curve("d", 1, {20})}, 3);
  EXPECT_EQ(names(merged.curves), "abd");
}

TEST(Merge, MakesOneOfAll) {
  const Merged merged = merge({curve("a", 1, {10}), curve("b", 1, {20}), curve("c", 2, {30})}, 1);
  ASSERT_EQ(merged.curves.size(), 1U);
  EXPECT_EQ(merged.curves[0].weight, 4.0);
  EXPECT_DOUBLE_EQ(merged.curves[0].snr_db[0], 22.5);
  EXPECT_EQ(merged.curves[0].name, "c");
}

TEST(Merge, CallsWhatItMergedTwiceByTheHeaviestOfAll) {
  EXPECT_EQ(names(merge({curve("a", 3, {10}), curve("b", 5, {10.5}), curve("c", 4, {14})}, 1).curves), "b");
}

/// b and c are each audible where the other is not; their mean is nowhere, as a, which so far was nearest to d.
TEST(Merge, SeesWhenWhatItHasMergedComesNearerToAnotherThanBothWere) {
  const Merged merged =
      merge({curve("a", 1, {-9, -9, -9}), curve("b", 0.1, {-4, 3, -9}), curve("c", 0.1, {3, -4, -9}), curve("d", 1, {-9, -9, 1.1})}, 2);
  ASSERT_EQ(names(merged.curves), "ad");
  EXPECT_DOUBLE_EQ(merged.curves[0].weight, 1.2);
  EXPECT_DOUBLE_EQ(merged.curves[1].weight, 1.0);
}

/// Every step looks at all pairs: what the quicker search must come to.
std::vector<double> weights_after_slow_merging(std::vector<OceanCurve> curves, std::size_t at_most) {
  while (curves.size() > at_most) {
    std::size_t first = 0;
    std::size_t second = 1;
    double least = 1e300;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      for (std::size_t j = i + 1; j < curves.size(); ++j) {
        const double d = difference_db(curves[i].snr_db, curves[j].snr_db);
        const double cost = curves[i].weight * curves[j].weight / (curves[i].weight + curves[j].weight) * d * d;
        if (cost < least) least = cost, first = i, second = j;
      }
    }
    OceanCurve& to = curves[first];
    const OceanCurve& from = curves[second];
    for (std::size_t i = 0; i < to.snr_db.size(); ++i)
      to.snr_db[i] = (to.weight * to.snr_db[i] + from.weight * from.snr_db[i]) / (to.weight + from.weight);
    to.weight += from.weight;
    curves.erase(curves.begin() + static_cast<std::ptrdiff_t>(second));
  }
  std::vector<double> weights;
  for (const OceanCurve& c : curves) weights.push_back(c.weight);
  return weights;
}

TEST(Merge, ComesToWhatLookingAtAllPairsEachTimeDoes) {
  std::vector<OceanCurve> curves;
  unsigned state = 1;
  const auto random = [&state](double least, double most) {
    state = state * 1664525U + 1013904223U;
    return least + (most - least) * static_cast<double>(state >> 16U) / 65536.0;
  };
  // Half of it is not audible: what is merged may come nearer to a third than both were.
  const auto snr = [&random] { return random(-40.0, 40.0); };
  for (int i = 0; i < 60; ++i) curves.push_back(curve("x", random(1.0, 30.0), {snr(), snr(), snr()}));
  for (const std::size_t at_most : {40U, 11U, 2U}) {
    std::vector<double> weights;
    for (const OceanCurve& c : merge(curves, at_most).curves) weights.push_back(c.weight);
    EXPECT_EQ(weights, weights_after_slow_merging(curves, at_most)) << at_most;
  }
}

}  // namespace
}  // namespace earshot::tables
