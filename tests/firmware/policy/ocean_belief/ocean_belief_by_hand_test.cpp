#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "tests/firmware/policy/ocean_belief/ocean_rig.hpp"

namespace earshot::policy {
namespace {

using Looks = std::vector<std::pair<NorthEast, Reception>>;

constexpr auto kTwoPerKilometre = [](double km) { return 30.0 - 2.0 * km; };

/// By hand: each hypothesis that is held, weighed by its prior and by all that was heard, before each of which the source may have moved.
/// Where it was declared found and the search went on it is not within a step.
class MixtureByHand {
 public:
  MixtureByHand(const OceanBelief& belief, const BeliefModel& model, const OceanTables& tables)
      : belief_(belief), model_(model), tables_(tables) {
    for (std::size_t k = 0; k < OceanBelief::kHypotheses; ++k) add(belief.hypothesis(k));
  }

  void hear(NorthEast place, Reception reception, bool was_declared) {
    for (std::size_t k = 0; k < joint_.size(); ++k) {
      move(k);
      const std::vector<long double> by_range = likelihoods_by_hand(model_, tables_, belief_.hypothesis(k), reception);
      for (std::size_t i = 0; i < 400; ++i) {
        const std::size_t range = range_of(model_, tables_, place, i);
        joint_[k][i] *= by_range[range] * (was_declared ? left_of_cell(model_, tables_, range) : 1.0L);
      }
    }
  }

  /// Half a unit of 0.14 % is rounded at every look, in the evidence and in every movement; hypotheses below 1e-4 are left out.
  void expect_same() const {
    long double total = 0.0L;
    for (const auto& p : joint_) total += sum_of(p);
    for (std::size_t k = 0; k < joint_.size(); ++k) {
      const auto share = static_cast<double>(sum_of(joint_[k]) / total);
      EXPECT_NEAR(double{belief_.share(k)}, share, 0.01 * share + 1e-9) << k;
    }
    for (std::size_t i = 0; i < 400; ++i) {
      long double sum = 0.0L;
      for (const auto& p : joint_) sum += p[i];
      const auto expected = static_cast<double>(sum / total);
      ASSERT_NEAR(double{belief_.probability(model_, i / 20, i % 20)}, expected, 0.01 * expected + 1e-6) << i;
    }
  }

 private:
  static long double sum_of(const std::vector<long double>& p) { return std::accumulate(p.begin(), p.end(), 0.0L); }

  void add(const Hypothesis& h) { joint_.emplace_back(400, std::exp2(static_cast<long double>(log_prior(h, tables_)) / 512.0L)); }

  void move(std::size_t k) {
    constexpr std::array<long double, 4> kPenalty{0.0L, 0.125L, 0.5L, 0.5L};
    constexpr std::array<int, 4> kReach{0, 1, 1, 2};
    const auto mobility = belief_.hypothesis(k).mobility;
    std::vector<long double> moved(400);
    for (int i = 0; i < 400; ++i) {
      const int far = kReach[mobility];
      for (int n = std::max(0, i / 20 - far); n <= std::min(19, i / 20 + far); ++n) {
        for (int e = std::max(0, i % 20 - far); e <= std::min(19, i % 20 + far); ++e) {
          const auto cells = static_cast<long double>(std::abs(n - i / 20) + std::abs(e - i % 20));
          long double& to = moved[static_cast<std::size_t>(i)];
          to = std::max(to, std::pow(kPenalty[mobility], cells) * joint_[k][static_cast<std::size_t>(n * 20 + e)]);
        }
      }
    }
    const long double scale = sum_of(joint_[k]) / sum_of(moved);
    for (std::size_t i = 0; i < 400; ++i) joint_[k][i] = moved[i] * scale;
  }

  const OceanBelief& belief_;
  const BeliefModel& model_;
  const OceanTables& tables_;
  std::vector<std::vector<long double>> joint_;  ///< [hypothesis][cell]
};

class OceanBeliefByHand : public testing::Test {
 protected:
  [[nodiscard]] std::vector<Hypothesis> held() const {
    std::vector<Hypothesis> all;
    for (std::size_t i = 0; i < OceanBelief::kHypotheses; ++i) all.push_back(belief->hypothesis(i));
    return all;
  }

  BeliefModel model = small_model();
  OceanTables tables = no_tables(kSmallRanges);
  std::unique_ptr<OceanBelief> belief = std::make_unique<OceanBelief>();
};

TEST_F(OceanBeliefByHand, IsTheMixtureByHandOfTheHypothesesThatItHolds) {
  add_table(tables, 1.0F, kTwoPerKilometre);
  const Looks looks = {{at(3'200, 4'100), {.snr = Decibels{23.0}}},
                       {at(-1'000, 2'000), {.snr = Decibels{17.0}, .too_faint = true}},
                       {at(8'000, -1'500), {.snr = Decibels{17.0}}},
                       {at(4'000, 5'300), {.snr = Decibels{25.0}}}};
  belief->start(model, tables);
  for (const auto& [place, reception] : looks) belief->update(model, tables, place, reception);
  EXPECT_FALSE(belief->declaration()) << "so that nothing is ruled out, though the search goes on";
  MixtureByHand by_hand(*belief, model, tables);
  for (const auto& [place, reception] : looks) by_hand.hear(place, reception, false);
  by_hand.expect_same();
}

/// 40 dB at the source, ten less per kilometre.
constexpr auto kTenPerKilometre = [](double km) { return 40.0 - 10.0 * km; };

/// On the way to a source, past it and away, as it is heard.
Looks past(NorthEast source) {
  Looks looks;
  for (const NorthEast place : {at(2'000, 2'000), at(2'000, 6'000), at(4'000, 7'000), at(6'000, 6'000), at(6'100, 4'100), at(8'000, 3'000),
                                at(9'000, 6'000), at(7'000, 8'000), at(5'000, 9'000)})
    looks.push_back({place, {.snr = Decibels{kTenPerKilometre(range_between(place, source).value / 1'000.0)}}});
  return looks;
}

TEST_F(OceanBeliefByHand, DeclaresTheSourceFoundWhereItIsAndThenRulesThatOutInEveryHypothesisThatItHoldsOrTakesUp) {
  add_table(tables, 1.0F, kTenPerKilometre);
  const NorthEast source = at(6'200, 4'300);
  const Looks looks = past(source);
  belief->start(model, tables);
  std::vector<bool> declared;
  std::vector<Hypothesis> at_declaration;
  for (const auto& [place, reception] : looks) {
    belief->update(model, tables, place, reception);
    declared.push_back(belief->declaration().has_value());
    if (!declared.back()) continue;
    at_declaration = held();
    EXPECT_LT(range_between(place, source).value, 1'000.0);
    EXPECT_LT(range_between(belief->declaration()->likeliest, source).value, 500.0);
    EXPECT_EQ(belief->declaration()->look, declared.size() - 1);
    EXPECT_EQ(belief->declaration()->snr, reception.snr);
    EXPECT_GT(range_between(belief->summary().likeliest, place).value, 750.0) << "of a search that goes on";
  }
  EXPECT_EQ(std::ranges::count(declared, true), 1) << "not again, where it was not";
  EXPECT_NE(held(), at_declaration) << "others were taken up since";
  MixtureByHand by_hand(*belief, model, tables);
  for (std::size_t i = 0; i < looks.size(); ++i) by_hand.hear(looks[i].first, looks[i].second, declared[i]);
  by_hand.expect_same();
}

/// A spread of 1 to 7 dB and a level unknown by 9: 20 dB a kilometre away is as it should be, a tenth of a decibel is not.
TEST_F(OceanBeliefByHand, DeclaresNothingFoundThatPausesOrThatIsFarFainterThanItShouldBe) {
  add_table(tables, 1.0F, kTenPerKilometre);
  const NorthEast source = at(6'200, 4'300);
  for (const Reception unheard : {Reception{.snr = Decibels{3.0}, .too_faint = true}, Reception{.snr = Decibels{0.1}}}) {
    belief->start(model, tables);
    for (const auto& [place, reception] : past(source)) {
      if (range_between(place, source).value < 1'000.0) {
        belief->update(model, tables, place, unheard);
        EXPECT_FALSE(belief->declaration());
      } else {
        belief->update(model, tables, place, reception);
      }
    }
  }
}

TEST_F(OceanBeliefByHand, CountsLooksAndForgetsItsDeclarationWhenItStarts) {
  add_table(tables, 1.0F, kTenPerKilometre);
  const Looks looks = past(at(6'200, 4'300));
  for (int search = 0; search < 2; ++search) {
    belief->start(model, tables);
    EXPECT_FALSE(belief->declaration());
    for (std::size_t i = 0; i < 5; ++i) belief->update(model, tables, looks[i].first, looks[i].second);
    ASSERT_TRUE(belief->declaration());
    EXPECT_EQ(belief->declaration()->look, 4U);
  }
}

}  // namespace
}  // namespace earshot::policy
