#include "firmware/policy/ocean_belief/ocean_belief.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/firmware/emulated.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_belief_rig.hpp"

namespace earshot::policy {
namespace {

class OceanBeliefTest : public OceanBeliefRig {
 protected:
  [[nodiscard]] double share_of_table(std::size_t table) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) sum += belief->hypothesis(i).table == table ? double{belief->share(i)} : 0.0;
    return sum;
  }

  static std::size_t distinct(const std::vector<Hypothesis>& all) {
    std::set<std::tuple<int, int, int, int, int, int, int, bool>> different;
    for (const Hypothesis& h : all)
      different.emplace(h.table, h.level, h.spread, h.silence, h.mobility, h.drift.north, h.drift.east, h.drift.is_current);
    return different.size();
  }
};

TEST_F(OceanBeliefTest, StartsWithEveryPlaceAsLikelyAndEveryHypothesisOnce) {
  for (int count = 1; count <= 40; ++count) {
    add_table(tables, count == 3 ? 8.0F : 1.0F, kTwoPerKilometre);
    belief->start(model, tables);
    EXPECT_EQ(distinct(retained()), OceanBelief::kHypotheses) << "one that is retained twice counts twice; of " << count << " tables";
    double sum = 0.0;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
      EXPECT_LT(belief->hypothesis(i).table, count);
      sum += double{belief->share(i)};
    }
    EXPECT_NEAR(sum, 1.0, 1e-6);
  }
  EXPECT_EQ(belief->hypothesis(0), (Hypothesis{.table = 2})) << "the likeliest";
  for (std::size_t i = 0; i < 400; ++i) ASSERT_FLOAT_EQ(belief->probability(model, i / 20, i % 20), 1.0F / 400.0F);
}

/// Half of it beyond the threshold in every ocean and at every spread, the level as likely above as below, but for pauses.
TEST_F(OceanBeliefTest, ForeseesDetectionsUnderItsHypothesesByTheirShares) {
  model.detection_threshold = Decibels{10.0};
  add_table(tables, 1.0F, [](double) { return 10.0; });
  belief->start(model, tables);
  for (int i = 0; i < 4; ++i) hear(at(-1'000, 3'000), 11.0);
  double expected = 0.0;
  for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
    const Hypothesis h = belief->hypothesis(i);
    const double z = (3.0 * (h.level - 3)) / std::array{1.0, 2.0, 4.0, 7.0}[h.spread];
    expected += double{belief->share(i)} * (1.0 - 0.25 * h.silence) * 0.5 * std::erfc(-z / std::sqrt(2.0));
  }
  for (std::size_t action = 0; action < 4; ++action)
    EXPECT_NEAR(belief->action_values(action).detected, expected, 2e-3);  // 24 of 1e-4 left out
  EXPECT_GT(expected, 0.4);
}

TEST_F(OceanBeliefTest, FindsOutInWhichOceanItIsAndWhereTheSourceIs) {
  add_table(tables, 1.0F, [](double km) { return 24.0 - 0.5 * km; });
  add_table(tables, 1.0F, kTwoPerKilometre);
  const auto truth = [](double km) { return 45.0 - 5.0 * km; };
  add_table(tables, 1.0F, truth);
  for (std::uint64_t seed = 1; seed <= tests::times(6, 2); ++seed) {
    Pcg32 random(seed, 7);
    const double north_m = 1'000.0 + 8'000.0 * random.uniform_double();
    const NorthEast source = at(north_m, 1'000.0 + 8'000.0 * random.uniform_double());
    belief->start(model, tables);
    for (const auto& [place, reception] : zigzag(25, truth, source, seed)) {
      if (range_between(place, source).value > 1'300.0) belief->update(model, tables, place, reception);
    }
    EXPECT_GT(share_of_table(2), 0.95) << seed;
    EXPECT_LT(range_between(belief->summary().likeliest, source).value, 1'000.0) << seed;
  }
}

/// 60 oceans, of which it begins with the first 16 and the likeliest; a shadow up to 4 km has the 58th alone.
TEST_F(OceanBeliefTest, FindsAnOceanThatItDoesNotBeginWith) {
  const auto truth = [](double km) { return km < 4.0 ? 5.0 : 30.0 - 2.0 * km; };
  for (int k = 0; k < 60; ++k) {
    if (k == 57) {
      add_table(tables, 1.0F, truth);
    } else {
      add_table(tables, 1.0F, [k](double km) { return 25.0 + 0.1 * k - (0.3 + 0.05 * k) * km; });
    }
  }
  belief->start(model, tables);
  for (const Hypothesis& h : retained()) EXPECT_NE(h.table, 57);
  const NorthEast source = at(6'200, 5'900);
  for (const auto& [place, reception] : zigzag(25, truth, source, 5)) {
    if (range_between(place, source).value > 1'300.0) belief->update(model, tables, place, reception);
  }
  EXPECT_GT(share_of_table(57), 0.95);
  EXPECT_LT(range_between(belief->summary().likeliest, source).value, 1'000.0);
}

TEST_F(OceanBeliefTest, FindsOutThatSourcesAreLouderAndThatCallsPause) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  const NorthEast source = at(7'000, 6'000);
  const auto louder = [](double km) { return 39.0 - 2.0 * km; };
  Measurements measurements = zigzag(24, louder, source, 3);
  for (std::size_t i = 0; i < measurements.size(); i += 2) measurements[i].second = {.snr = Decibels{3.0}, .too_faint = true};
  belief->start(model, tables);
  for (const auto& [place, reception] : measurements) {
    if (range_between(place, source).value > 1'300.0) belief->update(model, tables, place, reception);
  }
  double level_db = 0.0;
  double silence = 0.0;
  for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
    level_db += double{belief->share(i)} * double{kLevelOffsets_db[belief->hypothesis(i).level]};
    silence += double{belief->share(i)} * double{kSilenceShares[belief->hypothesis(i).silence]};
  }
  EXPECT_NEAR(level_db, 9.0, 2.0);
  EXPECT_NEAR(silence, 0.5, 0.15);
}

TEST_F(OceanBeliefTest, HasSharesAndPlacesThatAddUpToOneAndNothingTwice) {
  for (int k = 0; k < 5; ++k) add_table(tables, 1.0F + static_cast<float>(k), [k](double km) { return 30.0 - (1.0 + k) * km; });
  belief->start(model, tables);
  Pcg32 random(6);
  for (int measurement = 0; measurement < 40; ++measurement) {
    const double north_m = 10'000 * random.uniform_double();
    const NorthEast place = at(north_m, 10'000 * random.uniform_double());
    hear(place, 40.0 * random.uniform_double());
    double shares = 0.0;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) shares += double{belief->share(i)};
    EXPECT_NEAR(shares, 1.0, 1e-5);
    double places = 0.0;
    for (std::size_t i = 0; i < 400; ++i) places += double{belief->probability(model, i / 20, i % 20)};
    EXPECT_NEAR(places, 1.0, 24e-4);  // hypotheses below 1e-4 are left out
    ASSERT_EQ(distinct(retained()), OceanBelief::kHypotheses) << measurement;
  }
}

TEST_F(OceanBeliefTest, GoesOnWithWhatItHoldsWhenThereAreMoreMeasurementsThanItRemembers) {
  for (int k = 0; k < 5; ++k) add_table(tables, 1.0F, [k](double km) { return 30.0 - (1.0 + k) * km; });
  belief->start(model, tables);
  const auto measurement = [this](std::size_t i) {
    hear(at(static_cast<double>(i * 7'919 % 10'000), static_cast<double>(i * 104'729 % 10'000)), 5.0 + static_cast<double>(i % 20));
  };
  std::vector<Hypothesis> before;
  int exchanges = 0;
  for (std::size_t i = 0; i < config::kMaxBeliefMeasurements; ++i) {
    measurement(i);
    exchanges += retained() != before ? 1 : 0;
    before = retained();
  }
  EXPECT_GT(exchanges, 10);
  const std::uint32_t last = belief->fingerprint(model);
  for (std::size_t i = config::kMaxBeliefMeasurements; i < config::kMaxBeliefMeasurements + 20; ++i) {
    measurement(i);
    EXPECT_EQ(retained(), before) << i;
  }
  EXPECT_NE(belief->fingerprint(model), last);
  EXPECT_TRUE(std::isfinite(belief->action_values(kNorth).regret));
  belief->start(model, tables);  // remembers again
  const std::vector<Hypothesis> first = retained();
  for (std::size_t i = 0; i < 10; ++i) measurement(i);
  EXPECT_NE(retained(), first);
}

TEST_F(OceanBeliefTest, BelievesTheSameWhoeverRefinedItWhen) {
  for (int k = 0; k < 40; ++k) add_table(tables, 1.0F, [k](double km) { return 30.0 - (1.0 + 0.1 * k) * km; });
  const auto refining = std::make_unique<OceanBelief>();
  belief->start(model, tables);
  refining->start(model, tables);
  Pcg32 random(3);
  int slices = 0;
  int left = 0;
  for (const auto& [place, reception] : zigzag(25, kTwoPerKilometre, at(6'000, 2'000), 9)) {
    belief->update(model, tables, place, reception);
    refining->update(model, tables, place, reception);
    ASSERT_EQ(belief->fingerprint(model), refining->fingerprint(model));
    const NorthEast likeliest = refining->summary().likeliest;
    const float regret = refining->action_values(kEast).regret;
    bool is_left = true;
    for (int more = static_cast<int>(10.0F * random.uniform_float()); more > 0 && is_left; --more, ++slices)
      is_left = refining->refine(model, tables);
    left += is_left ? 1 : 0;
    EXPECT_EQ(refining->summary().likeliest, likeliest);
    EXPECT_EQ(refining->action_values(kEast).regret, regret);
  }
  EXPECT_GT(slices, 50);
  EXPECT_GT(left, 5) << "in some turns there was no time for all of it";
  EXPECT_LT(left, 20);
}

/// As loud everywhere: nothing is learned of the place, and a way costs the same but for where it leads back to.
TEST_F(OceanBeliefTest, CountsTheCostOfGoingBackToWhereTheVehicleWas) {
  add_table(tables, 1.0F, [](double) { return 20.0; });
  model.costs.most_regret = 1'000.0F;
  const auto regrets_after = [this](const std::vector<NorthEast>& places) {
    belief->start(model, tables);
    for (const NorthEast place : places) hear(place, 20.0);
    std::array<float, 4> regrets{};
    for (std::size_t a = 0; a < regrets.size(); ++a) regrets[a] = belief->action_values(a).regret - belief->action_values(kEast).regret;
    return regrets;
  };
  const std::array<float, 4> never_there = regrets_after({at(9'500, 9'500), at(6'000, 5'000)});
  const std::array<float, 4> once = regrets_after({at(5'150, 5'150), at(6'000, 5'000)});
  const std::array<float, 4> next_to_it = regrets_after({at(5'250, 5'100), at(6'000, 5'000)});
  for (const std::size_t action : {kNorth, kEast, kSouth, kWest}) {
    EXPECT_NEAR(once[action] - never_there[action], action == kSouth ? 10.0F : 0.0F, 0.05F) << action;
    EXPECT_NEAR(next_to_it[action] - never_there[action], 0.0F, 0.05F) << action;
  }
}

TEST_F(OceanBeliefTest, ForgetsEverythingWhenItStarts) {
  for (int k = 0; k < 5; ++k) add_table(tables, 1.0F, [k](double km) { return 30.0 - (1.0 + k) * km; });
  const NorthEast source = at(3'000, 8'000);
  belief->start(model, tables);
  hear_all(zigzag(17, kTwoPerKilometre, source, 8));  // in the midst of weighing others
  const auto fresh = std::make_unique<OceanBelief>();
  belief->start(model, tables);
  fresh->start(model, tables);
  EXPECT_EQ(belief->fingerprint(model), fresh->fingerprint(model));
  for (const auto& [place, reception] : zigzag(12, kTwoPerKilometre, at(6'000, 2'000), 9)) {
    belief->update(model, tables, place, reception);
    fresh->update(model, tables, place, reception);
    ASSERT_EQ(belief->fingerprint(model), fresh->fingerprint(model));
    EXPECT_EQ(belief->summary().likeliest, fresh->summary().likeliest);
  }
}

/// Other hypotheses that had heard only some of the measurements when the search ended, all of them as likely as can be, count no longer in
/// one that begins with what nobody expects.
TEST_F(OceanBeliefTest, ForgetsThoseThatItWasWeighingWhenItStarts) {
  for (int k = 0; k < 5; ++k) add_table(tables, 1.0F, [k](double km) { return 30.0 - (1.0 + k) * km; });
  const auto fresh = std::make_unique<OceanBelief>();
  for (int measurements = 15; measurements < tests::times(25, 18); ++measurements) {
    belief->start(model, tables);
    for (int i = 0; i < measurements; ++i) belief->update(model, tables, at(-1'000, 500.0 * i), {.snr = Decibels{90.0}, .too_faint = true});
    belief->start(model, tables);
    fresh->start(model, tables);
    for (OceanBelief* each : {belief.get(), fresh.get()}) each->update(model, tables, at(-1'000, 3'000), {.snr = Decibels{90.0}});
    EXPECT_EQ(belief->fingerprint(model), fresh->fingerprint(model)) << measurements;
  }
}

TEST_F(OceanBeliefTest, HasTheSameBitsOnEveryMachine) {
  BeliefModel large = bare_model(at(25'000, 25'000), 50, 50);
  large.outlier_share = 0.02F;
  OceanTables oceans = no_tables(400);
  for (int k = 0; k < 20; ++k)
    add_table(oceans, 1.0F + static_cast<float>(k % 3), [k](double km) {  // of whole numbers: a machine may fuse what is none
      return 0.5 * static_cast<double>(70 - (4 + k) * std::lround(10.0 * km) / 40);
    });
  belief->start(large, oceans);
  Pcg32 random(9);
  for (int i = 0; i < 40; ++i) {
    const double north_m = 25'000 * random.uniform_double();  // one after the other: arguments are drawn in any order
    const double east_m = 25'000 * random.uniform_double();
    belief->update(large, oceans, at(north_m, east_m), {.snr = Decibels{30.0 * random.uniform_double()}, .too_faint = i % 5 == 0});
  }
  EXPECT_EQ(belief->fingerprint(large), 0xC460E5FAU);  // of x86-64, for SSE2 and for AVX2, and of aarch64
}

/// As loud everywhere, so that a bearing alone tells of the place: from outside, where nothing is ruled out.
/// A thousandth of the noise's power: only a simulation can give such a number.
TEST_F(OceanBeliefTest, TakesAnSnrThatNoHydrophoneMeasuresForOneThatIsTooFaint) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  const auto fingerprint_after = [&](Reception reception) {
    belief->start(model, tables);
    for (int i = 0; i < 6; ++i) belief->update(model, tables, at(-1'000.0 * i, 3'000), reception);
    return belief->fingerprint(model);
  };
  const std::uint32_t too_faint = fingerprint_after({.snr = Decibels{-30.0}, .too_faint = true});
  EXPECT_EQ(fingerprint_after({.snr = Decibels{-30.01}}), too_faint);
  EXPECT_EQ(fingerprint_after({.snr = Decibels{-85.0}}), too_faint);
  EXPECT_EQ(fingerprint_after({.snr = Decibels{-60.0}, .too_faint = true}), too_faint);
  EXPECT_NE(fingerprint_after({.snr = Decibels{-30.0}}), too_faint) << "this one can be a measurement";
  model.detection_threshold = Decibels{-40.0};
  EXPECT_NE(fingerprint_after({.snr = Decibels{-35.0}}), fingerprint_after({.snr = Decibels{-30.0}, .too_faint = true})) << "a detection";
}

TEST_F(OceanBeliefTest, TakesABearingAsOneMoreLikelihood) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  add_table(tables, 1.0F, [](double) { return 20.0; });
  belief->start(model, tables);
  const NorthEast place = at(-3'000, 12'000);
  const messages::Bearing bearing{.direction = Radians{330.0 * kDegree}, .deviation = Radians{12.0 * kDegree}};
  belief->update(model, tables, place, {.snr = Decibels{20.0}, .bearing = bearing});
  std::vector<double> by_hand;
  for (std::size_t i = 0; i < 400; ++i) by_hand.push_back(bearing_likelihood_by_hand(place, bearing, i));
  const double sum = std::accumulate(by_hand.begin(), by_hand.end(), 0.0);
  // A log weight is half a unit of 1/512 off, 0.07 %, and 2^w 0.008 %.
  for (std::size_t i = 0; i < 400; ++i)
    EXPECT_NEAR(double{belief->probability(model, i / 20, i % 20)} / (by_hand[i] / sum), 1.0, 2e-3) << i;
}

/// Before the first measurement every place is as likely as another, and moving from there leaves it so: what a bearing says of a source
/// that moves is what it says of one that rests. Were it heard first, the movement would spread it.
TEST_F(OceanBeliefTest, HearsABearingWhereASourceThatMovesIsNow) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  add_table(tables, 1.0F, [](double) { return 20.0; });
  belief->start(model, tables);
  const messages::Bearing bearing{.direction = Radians{60.0 * kDegree}, .deviation = Radians{4.0 * kDegree}};
  belief->update(model, tables, at(-1'000, 5'000), {.snr = Decibels{20.0}, .bearing = bearing});
  const auto places_of = [&](const Hypothesis& wanted) {
    std::vector<float> joint(400, 0.0F);
    for (std::size_t k = 0; k < OceanBelief::kHypotheses; ++k) {
      if (belief->hypothesis(k) == wanted) belief->add_joint(model, k, joint);
    }
    const float sum = std::accumulate(joint.begin(), joint.end(), 0.0F);
    EXPECT_GT(sum, 0.0F);
    for (float& p : joint) p /= sum;
    return joint;
  };
  const std::vector<float> at_rest = places_of({});
  const std::vector<float> moving = places_of({.mobility = 1});
  for (std::size_t i = 0; i < 400; ++i) EXPECT_NEAR(moving[i], at_rest[i], 1e-5) << i;
}

/// Where nothing else tells of the place a bearing says nothing of the ocean, whether a hypothesis was retained when it came or drawn
/// later.
TEST_F(OceanBeliefTest, LearnsNothingOfTheOceanFromBearings) {
  for (int k = 0; k < 40; ++k) add_table(tables, 1.0F, [k](double) { return 0.5 * k; });
  const auto without = std::make_unique<OceanBelief>();
  belief->start(model, tables);
  without->start(model, tables);
  for (int i = 0; i < 12; ++i) {
    const NorthEast place = at(-2'000, 1'000 * i);
    const messages::Bearing bearing{.direction = Radians{0.2 * i - 1.0}, .deviation = Radians{0.3}};
    belief->update(model, tables, place, {.snr = Decibels{12.0}, .bearing = bearing});
    without->update(model, tables, place, {.snr = Decibels{12.0}});
  }
  const auto likeliest_at_rest = [](const OceanBelief& of) {
    std::vector<std::pair<float, std::size_t>> shares;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
      if (of.hypothesis(i).mobility == 0) shares.emplace_back(of.share(i), i);
    }
    return *std::max_element(shares.begin(), shares.end());
  };
  const auto [share, best] = likeliest_at_rest(*without);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) {
    for (std::size_t j = 0; j < OceanBelief::kHypotheses; ++j) {
      const Hypothesis& h = without->hypothesis(j);
      if (h.mobility != 0 || !(belief->hypothesis(i) == h) || without->share(j) < 1e-3F) continue;
      for (std::size_t b = 0; b < OceanBelief::kHypotheses; ++b) {
        if (!(belief->hypothesis(b) == without->hypothesis(best))) continue;
        // Each measurement rounds a weight by up to a unit, and a place that is forgotten is a little more likely than it was.
        EXPECT_NEAR(double{belief->share(i)} / double{belief->share(b)}, double{without->share(j)} / double{share}, 0.05);
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 5U);
}

TEST_F(OceanBeliefTest, HoldsTheLargestModelAndTablesThereIsRoomFor) {
  BeliefModel largest = bare_model(at(25'000, 25'000), 50, 50);
  while (largest.actions.push_back({1, 0}) == Status::kOk) {
  }
  OceanTables full = no_tables(config::kMaxTableRanges);
  OceanTable table;
  table.snr_half_db.fill(20);  // 10 dB
  while (full.tables.push_back(table) == Status::kOk) {
  }
  belief->start(largest, full);
  for (int measurement = 0; measurement < 3; ++measurement) belief->update(largest, full, at(-20'000, 12'500), {.snr = Decibels{10.0}});
  // As loud everywhere: nothing is learned of the place.
  for (std::size_t i = 0; i < 2'500; ++i) ASSERT_NEAR(belief->probability(largest, i / 50, i % 50), 4e-4, 1e-6) << i;
  EXPECT_TRUE(std::isfinite(belief->action_values(config::kMaxActions - 1).regret));
}

}  // namespace
}  // namespace earshot::policy
