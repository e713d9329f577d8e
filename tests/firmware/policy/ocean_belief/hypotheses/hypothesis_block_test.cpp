#include "firmware/policy/ocean_belief/hypotheses/hypothesis_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "firmware/policy/likelihood/belief_grid.hpp"
#include "firmware/policy/ocean_belief/hypotheses/cell_places.hpp"
#include "firmware/policy/ocean_belief/hypotheses/lane_likelihoods.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_rig.hpp"

namespace earshot::policy {
namespace {

/// At rest, one cell at 3 octaves or at 1, two cells at 1 each; and again.
constexpr std::array<Hypothesis, kLanes> kAllMotions{{{.mobility = 0},
                                                      {.mobility = 1},
                                                      {.mobility = 2},
                                                      {.mobility = 3},
                                                      {.mobility = 0},
                                                      {.mobility = 1},
                                                      {.mobility = 2},
                                                      {.mobility = 3}}};

constexpr Lanes kAllLanes{true, true, true, true, true, true, true, true};

/// As HypothesisBlock::weigh() takes them.
LogLanes raised(const LogLanes& log_likelihoods) {
  return log_likelihoods - kLeastLogLikelihood;
}

class HypothesisBlockTest : public testing::Test {
 protected:
  /// Probability of every cell under one of the hypotheses.
  static std::vector<float> places(const HypothesisBlock& block, const BeliefModel& model, std::size_t lane) {
    FloatLanes shares{};
    shares[lane] = 1.0F;
    std::vector<float> marginal(cell_count(model), 0.0F);
    block.add_to(model, shares, all_cells(model), false, marginal);
    return marginal;
  }

  /// Weighs every cell by a weight of its own, the same in all lanes.
  static void weigh_each(HypothesisBlock& block, const BeliefModel& model, const std::vector<int>& weights) {
    std::vector<LogLanes> lanes;
    for (const int weight : weights) lanes.push_back(raised(LogLanes{} + static_cast<std::int16_t>(weight)));
    std::vector<std::uint16_t> ranges(weights.size());
    std::iota(ranges.begin(), ranges.end(), std::uint16_t{0});
    block.weigh(model, kAllLanes, lanes, ranges);
  }

  std::unique_ptr<HypothesisBlock> block = std::make_unique<HypothesisBlock>();
};

TEST_F(HypothesisBlockTest, StartsWithEveryPlaceAsLikelyUnderEveryHypothesis) {
  const BeliefModel model = small_model();
  block->start(model, kAllMotions, PlacePrior{});
  for (std::size_t l = 0; l < kLanes; ++l) {
    for (const float p : places(*block, model, l)) ASSERT_NEAR(p, 1.0 / 400.0, 1e-5 / 400.0);  // a sum of 400 floats
    EXPECT_EQ(block->log_evidence(model)[l], std::lround(512.0 * std::log2(400.0)));
    EXPECT_EQ(block->hypothesis(l), kAllMotions[l]);
    EXPECT_TRUE(block->holds(kAllMotions[l]));
  }
  EXPECT_FALSE(block->holds({.level = 1}));
}

/// Bayes' rule with every factor written out, in double: two measurements from within and two from without, one of them too faint.
TEST_F(HypothesisBlockTest, IsWhatBayesRuleGivesByHandUnderEveryHypothesis) {
  const BeliefModel model = small_model();
  OceanTables tables = no_tables(kSmallRanges);
  add_table(tables, 1.0F, [](double km) { return 30.0 - 2.0 * km; });
  add_table(tables, 1.0F, [](double km) { return 18.0 + 5.0 * std::cos(km); });
  constexpr std::array<Hypothesis, kLanes> kHypotheses{{{0, 3, 2, 0, 0},
                                                        {1, 3, 2, 0, 0},
                                                        {0, 1, 2, 0, 0},
                                                        {0, 5, 1, 0, 0},
                                                        {1, 4, 3, 1, 0},
                                                        {1, 2, 1, 2, 0},
                                                        {0, 3, 3, 3, 0},
                                                        {0, 2, 3, 0, 0}}};
  const std::vector<std::pair<NorthEast, Reception>> measurements = {{at(3'200, 4'100), {.snr = Decibels{21.0}}},
                                                                     {at(-1'000, 2'000), {.snr = Decibels{15.0}, .too_faint = true}},
                                                                     {at(8'000, -1'500), {.snr = Decibels{17.0}}},
                                                                     {at(4'000, 4'300), {.snr = Decibels{24.0}}}};
  block->start(model, kHypotheses, PlacePrior{});
  LaneLikelihoods likelihoods;
  std::vector<std::uint16_t> ranges(400);
  CellPlaces places_of_cells;
  places_of_cells.find(model, {}, 0, {});
  for (const auto& [place, reception] : measurements) {
    places_of_cells.find_ranges(model, place, tables.range_step, kSmallRanges - 1U, ranges);
    likelihoods.tabulate(model, tables, kHypotheses, reception, tables.range_count);
    block->weigh(model, kAllLanes, likelihoods.raised_by_range(), ranges);
  }
  for (std::size_t l = 0; l < kLanes; ++l) {
    std::vector<double> joint(400, 1.0);
    for (const auto& [place, reception] : measurements) {
      const std::vector<double> by_range = likelihoods_by_hand(model, tables, kHypotheses[l], reception);
      for (std::size_t i = 0; i < joint.size(); ++i) joint[i] *= by_range[range_of(model, tables, place, i)];
    }
    const double total = std::accumulate(joint.begin(), joint.end(), 0.0);
    // Half a unit of 0.14 % is rounded at every measurement, and the table of the normal distribution is 0.2 % off at four standard
    // deviations.
    EXPECT_NEAR(block->log_evidence(model)[l], 512.0 * std::log2(total), 4.0) << l;
    const std::vector<float> found = places(*block, model, l);
    for (std::size_t i = 0; i < joint.size(); ++i) {
      const auto p = static_cast<double>(joint[i] / total);
      ASSERT_NEAR(double{found[i]}, p, 0.008 * p + 1e-8) << "lane " << l << ", cell " << i;
    }
  }
}

TEST_F(HypothesisBlockTest, WeighsEveryLaneByItsOwnLikelihood) {
  const BeliefModel model = bare_model(at(1'000, 2'000), 1, 2);
  block->start(model, {}, PlacePrior{});
  const std::array<LogLanes, 2> likelihoods{raised(LogLanes{0, -512, -1024, 0, 0, 0, 0, -5120}),
                                            raised(LogLanes{0, 0, 0, -512, -1024, -1536, -5120, -5120})};
  const std::array<std::uint16_t, 2> ranges{1, 0};  // the western cell is the further one
  block->weigh(model, kAllLanes, likelihoods, ranges);
  const std::array<double, kLanes> western{0.5, 2.0 / 3.0, 0.8, 1.0 / 3.0, 0.2, 1.0 / 9.0, 1.0 / 1025.0, 0.5};
  for (std::size_t l = 0; l < kLanes; ++l) {
    EXPECT_NEAR(places(*block, model, l)[0], western[l], 1e-4) << l;
    EXPECT_NEAR(places(*block, model, l)[1], 1.0 - western[l], 1e-4) << l;
  }
  EXPECT_EQ(block->log_evidence(model)[7], -5120 + 512);
}

/// Those that have the cells elsewhere keep their weights bit for bit, in whatever order they are weighed.
TEST_F(HypothesisBlockTest, WeighsSomeLanesAndLeavesTheOthers) {
  const BeliefModel model = bare_model(at(1'000, 2'000), 1, 2);
  const std::array<LogLanes, 2> likelihoods{raised(LogLanes{} - std::int16_t{100}), raised(LogLanes{} - std::int16_t{612})};
  const std::array<std::uint16_t, 2> ranges{0, 1};
  const std::array<std::uint16_t, 2> the_other_way{1, 0};
  Lanes even{};
  for (std::size_t l = 0; l < kLanes; l += 2) even[l] = true;
  Lanes odd{};
  for (std::size_t l = 1; l < kLanes; l += 2) odd[l] = true;
  block->start(model, {}, PlacePrior{});
  block->weigh(model, even, likelihoods, ranges);
  EXPECT_EQ(block->log_evidence(model)[1], 512);
  EXPECT_EQ(places(*block, model, 1)[0], 0.5F);
  block->weigh(model, odd, likelihoods, the_other_way);
  for (std::size_t l = 0; l < kLanes; ++l) {
    EXPECT_NEAR(places(*block, model, l)[0], l % 2 == 0 ? 2.0 / 3.0 : 1.0 / 3.0, 1e-4) << l;
    EXPECT_NEAR(block->log_evidence(model)[l], -100 + 512.0 * std::log2(1.5), 1.0) << l;
  }
}

/// Cells that have met at an edge hold the probability of both.
TEST_F(HypothesisBlockTest, AddsCellsToWhereTheyHaveGone) {
  const BeliefModel model = bare_model(at(2'000, 3'000), 2, 3);
  block->start(model, {}, PlacePrior{});
  weigh_each(*block, model, {0, -512, -1'024, -1'536, 0, 0});  // 8, 4, 2; 1, 8, 8 of 31
  const std::array<std::uint16_t, 5> axes{3, 0, 1, 2, 2};      // the southern row is now the northern one
  const auto expect = [&](const CellWindow& window, const std::array<double, 6>& expected) {
    std::vector<float> marginal(6, 1.0F);
    block->add_to(model, 3, 0.5F, axes, window, marginal);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(marginal[i], 1.0 + 0.5 * expected[i] / 31.0, 1e-4) << i;
  };
  expect(all_cells(model), {0, 1, 16, 0, 8, 6});
  expect({.north = {0, 1}, .east = {0, 3}}, {0, 1, 16, 0, 0, 0});
  expect({.north = {0, 2}, .east = {0, 2}}, {0, 1, 0, 0, 8, 0});
  expect({.north = {1, 2}, .east = {2, 3}}, {0, 0, 0, 0, 0, 6});
  expect({.north = {2, 2}, .east = {3, 3}}, {0, 0, 0, 0, 0, 0});
}

TEST_F(HypothesisBlockTest, AddsToNoCellOutsideTheWindow) {
  const BeliefModel model = bare_model(at(3'000, 4'000), 3, 4);
  block->start(model, {}, PlacePrior{});
  std::vector<float> marginal(12, 0.0F);
  block->add_to(model, {0.5F, 0.5F}, {.north = {1, 3}, .east = {2, 3}}, false, marginal);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(marginal[i], i == 6 || i == 10 ? 1.0 / 12.0 : 0.0, 1e-5) << i;
}

TEST_F(HypothesisBlockTest, AddsHypothesesByTheirSharesToWhatIsThere) {
  const BeliefModel model = bare_model(at(1'000, 2'000), 1, 2);
  block->start(model, {}, PlacePrior{});
  const std::array<LogLanes, 2> likelihoods{raised(LogLanes{0, 0, -512}), raised(LogLanes{-512, 0, 0})};
  block->weigh(model, kAllLanes, likelihoods, std::array<std::uint16_t, 2>{0, 1});
  std::vector<float> marginal{10.0F, 20.0F};
  const FloatLanes shares{0.25F, 0.5F, 0.125F, 0.125F};
  block->add_to(model, shares, all_cells(model), false, marginal);
  EXPECT_NEAR(marginal[0], 10.0 + 0.25 * 2 / 3 + 0.5 / 2 + 0.125 / 3 + 0.125 / 2, 1e-4);
  EXPECT_NEAR(marginal[1], 20.0 + 0.25 / 3 + 0.5 / 2 + 0.125 * 2 / 3 + 0.125 / 2, 1e-4);
  block->add_to(model, shares, all_cells(model), true, marginal);  // nothing counts that was there
  EXPECT_NEAR(marginal[0], 0.25 * 2 / 3 + 0.5 / 2 + 0.125 / 3 + 0.125 / 2, 1e-5);
  EXPECT_NEAR(marginal[1], 0.25 / 3 + 0.5 / 2 + 0.125 * 2 / 3 + 0.125 / 2, 1e-5);
}

/// After measurements that leave nothing of a place it is still believed in by 2^-26 of the likeliest, however much more is heard, and
/// sixteen bits hold what is taken off.
TEST_F(HypothesisBlockTest, ForgetsNoPlaceHoweverUnlikely) {
  const BeliefModel model = bare_model(at(1'000, 3'000), 1, 3);
  block->start(model, kAllMotions, PlacePrior{});
  for (int measurement = 0; measurement < 20; ++measurement) {
    weigh_each(*block, model, {kLeastLogLikelihood, kLeastLogLikelihood, measurement < 10 ? 0 : -9'000});
    const std::vector<float> p = places(*block, model, 4);
    for (const std::size_t i : {0U, 1U}) ASSERT_NEAR(p[i] / p[2], std::exp2(-26.0), 2e-4 * std::exp2(-26.0)) << measurement;
  }
  EXPECT_EQ(block->log_evidence(model)[0], 10 * -9'000);
  // As soon as it is the other way round it comes back.
  for (int measurement = 0; measurement < 2; ++measurement) weigh_each(*block, model, {0, kLeastLogLikelihood, kLeastLogLikelihood});
  EXPECT_GT(places(*block, model, 0)[0], 0.99F);
}

/// A source comes from every cell within reach, at what each step north or south, east or west costs; the likeliest way counts.
TEST_F(HypothesisBlockTest, LetsASourceMoveAsFarAsItsHypothesisSaysByHand) {
  const BeliefModel model = bare_model(at(3'000, 5'000), 3, 5);
  // clang-format off
  const std::vector<int> weights{-9'000, -12'000,  -7'000, -12'000,  -3'000,
                                 -12'000,  -500, -12'000, -11'500, -12'000,
                                      0, -12'000, -12'000, -12'000,  -8'000};
  // clang-format on
  block->start(model, kAllMotions, PlacePrior{});
  weigh_each(*block, model, weights);
  const std::array<int, kLanes> evidence = block->log_evidence(model);
  block->let_move(model);
  EXPECT_EQ(block->log_evidence(model), evidence) << "nothing has been heard";
  const std::array<int, 4> reach{0, 1, 1, 2};
  const std::array<int, 4> penalty{0, 1'536, 512, 512};
  for (std::size_t l = 0; l < kLanes; ++l) {
    const std::vector<float> p = places(*block, model, l);
    for (int i = 0; i < 15; ++i) {
      int likeliest = -100'000;
      for (int from = 0; from < 15; ++from) {
        const int north = std::abs(i / 5 - from / 5);
        const int east = std::abs(i % 5 - from % 5);
        if (std::max(north, east) > reach[l % 4]) continue;
        likeliest = std::max(likeliest, weights[static_cast<std::size_t>(from)] - penalty[l % 4] * (north + east));
      }
      EXPECT_NEAR(512.0 * std::log2(double{p[static_cast<std::size_t>(i)]} / double{p[10]}), likeliest, 0.15)
          << "lane " << l << ", cell " << i;
    }
  }
}

TEST_F(HypothesisBlockTest, LeavesSourcesAtRestBitForBitBesideOnesThatMove) {
  const BeliefModel model = small_model();
  const auto resting = std::make_unique<HypothesisBlock>();
  block->start(model, kAllMotions, PlacePrior{});
  resting->start(model, {}, PlacePrior{});
  Pcg32 random(3);
  for (int measurement = 0; measurement < 12; ++measurement) {
    std::vector<int> weights;
    for (int i = 0; i < 400; ++i) weights.push_back(-static_cast<int>(6'000.0F * random.uniform_float()));
    for (HypothesisBlock* each : {block.get(), resting.get()}) {
      each->let_move(model);
      weigh_each(*each, model, weights);
    }
  }
  for (const std::size_t l : {0U, 4U}) {
    EXPECT_EQ(places(*block, model, l), places(*resting, model, l));
    EXPECT_EQ(block->log_evidence(model)[l], resting->log_evidence(model)[l]);
  }
  for (const std::size_t l : {1U, 2U, 3U}) EXPECT_NE(places(*block, model, l), places(*resting, model, l));
}

/// The one taken over has weights of before its block settled, and must be settled where those around it are.
TEST_F(HypothesisBlockTest, SettlesAHypothesisThatItHasTakenOverSinceItSettled) {
  const BeliefModel model = small_model();
  const auto other = std::make_unique<HypothesisBlock>();
  block->start(model, kAllMotions, PlacePrior{});
  other->start(model, {}, PlacePrior{});
  weigh_each(*other, model, std::vector<int>(400, -700));
  block->let_move(model);
  block->take_over(model, 2, *other, 6);
  block->let_move(model);
  weigh_each(*block, model, std::vector<int>(400, 0));
  EXPECT_EQ(block->log_of_likeliest(2), -700);
  EXPECT_EQ(block->log_evidence(model)[2], std::lround(512.0 * std::log2(400.0)) - 700);
}

/// Two that rest beside one another are left alone, as one word or as part of one, when others move.
TEST_F(HypothesisBlockTest, LetsThoseMoveThatDoAndNoneBesideThem) {
  const BeliefModel model = small_model();
  std::array<Hypothesis, kLanes> hypotheses{};
  hypotheses[2].mobility = 1;
  hypotheses[6].mobility = 2;
  hypotheses[7].mobility = 3;
  block->start(model, hypotheses, PlacePrior{});
  std::vector<int> peak(400, -5'000);
  peak[210] = 0;
  weigh_each(*block, model, peak);
  std::array<std::vector<float>, kLanes> before;
  for (std::size_t l = 0; l < kLanes; ++l) before[l] = places(*block, model, l);
  const auto evidence = block->log_evidence(model);
  block->let_move(model);
  for (std::size_t l = 0; l < kLanes; ++l) {
    EXPECT_EQ(places(*block, model, l) == before[l], hypotheses[l].mobility == 0) << l;
    EXPECT_NEAR(block->log_evidence(model)[l], evidence[l], 1) << l;
  }
}

TEST_F(HypothesisBlockTest, TakesAHypothesisOverWithAllThatItHasHeard) {
  const BeliefModel model = small_model();
  const auto other = std::make_unique<HypothesisBlock>();
  block->start(model, {}, PlacePrior{});
  std::array<Hypothesis, kLanes> hypotheses = kAllMotions;
  hypotheses[6] = {7, 1, 3, 2, 2};
  other->start(model, hypotheses, PlacePrior{});
  const auto measurement = [&](HypothesisBlock& at, std::uint64_t seed) {
    Pcg32 weights(seed);
    std::vector<int> each;
    for (int i = 0; i < 400; ++i) each.push_back(-static_cast<int>(9'000.0F * weights.uniform_float()) - 300);
    at.let_move(model);
    weigh_each(at, model, each);
  };
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    measurement(*block, seed);
    measurement(*other, seed + 10);
  }
  const std::vector<float> neighbour = places(*block, model, 3);
  const std::uint32_t before = block->fingerprint(model, 0);
  block->take_over(model, 2, *other, 6);
  EXPECT_NE(block->fingerprint(model, 0), before);
  EXPECT_EQ(places(*block, model, 3), neighbour);
  EXPECT_EQ(block->hypothesis(2), hypotheses[6]);
  for (std::uint64_t seed = 20; seed < 23; ++seed) {
    EXPECT_EQ(places(*block, model, 2), places(*other, model, 6));
    EXPECT_EQ(block->log_evidence(model)[2], other->log_evidence(model)[6]);
    measurement(*block, seed);
    measurement(*other, seed);
  }
}

}  // namespace
}  // namespace earshot::policy
