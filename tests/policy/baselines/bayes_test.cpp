#include "policy/baselines/bayes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "policy/baselines/genetic.hpp"
#include "policy/baselines/infotaxis.hpp"
#include "policy/baselines/moves.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "sim/search/actions/compass_directions.hpp"

namespace earshot::baselines {
namespace {

constexpr NorthEast at(double north_m, double east_m) {
  return {Meters{north_m}, Meters{east_m}};
}

PriorKnowledge prior_with(const sonar::SnrCurve& curve) {
  return {.settings = {}, .actions = search::compass_directions(8), .snr = curve};
}

TEST(InformationGain, OfALookThatSoundsTheSameEverywhereIsThatOfFindingTheSourceOrNot) {
  const sonar::SnrCurve flat(Meters{1'000.0}, {15.0F});
  const PriorKnowledge prior = prior_with(flat);
  BayesInformationGain bayes(prior);
  bayes.begin(Pcg32(1));
  // Before any measurement: 2500 cells of 500 m; the centres of 12 of them lie within 1 km of a corner between cells.
  const double p = 12.0 / 2'500.0;
  EXPECT_NEAR(bayes.information_at(at(12'500, 12'500)), -p * std::log(p) - (1.0 - p) * std::log(1.0 - p), 1e-6);  // float probabilities
}

TEST(InformationGain, OfALookThatTellsNearFromFarIsThatOfTheTwoShares) {
  std::vector<float> snr_db(8, 40.0F);
  snr_db.insert(snr_db.end(), 40, -40.0F);
  const sonar::SnrCurve near_or_far(Meters{1'000.0}, snr_db);
  const PriorKnowledge prior = prior_with(near_or_far);
  BayesInformationGain bayes(prior);
  bayes.begin(Pcg32(1));
  const double found = 12.0 / 2'500.0;
  // Between 7 and 8 km the curve falls from 40 to -40 dB: its middle parts the two, and the cells on the slope tell more than that.
  const double near = 3.14159265 * 7.5 * 7.5 / 625.0 - found;
  const double far = 1.0 - found - near;
  const double two_shares = -found * std::log(found) - near * std::log(near) - far * std::log(far);
  EXPECT_GT(bayes.information_at(at(12'500, 12'500)), two_shares - 0.01);
  EXPECT_LT(bayes.information_at(at(12'500, 12'500)), two_shares + 0.5);
}

/// 30 dB at the source, one less per kilometre.
sonar::SnrCurve one_decibel_per_kilometer() {
  std::vector<float> snr_db;
  for (int km = 0; km <= 40; ++km) snr_db.push_back(30.0F - static_cast<float>(km));
  return sonar::SnrCurve(Meters{1'000.0}, snr_db);
}

template <class Searcher>
class Believers : public testing::Test {};
using AllBelievers = testing::Types<Bayes, BayesLeastRegret, BayesInformationGain, Infotaxis, Genetic>;
TYPED_TEST_SUITE(Believers, AllBelievers);

TYPED_TEST(Believers, FindNearlyAllSourcesInAnOceanThatTellsTheRange) {
  const sonar::SnrCurve curve = one_decibel_per_kilometer();
  const PriorKnowledge prior = prior_with(curve);
  search::SearchSettings settings;
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::inside_border(settings);
  const search::World world(settings, curve);
  TypeParam searcher(prior);
  int found = 0;
  for (const evaluate::Flight& flight : evaluate::fly(searcher, world, {.end = 16}, 1))
    found += flight.record.end == search::EpisodeEnd::kFound ? 1 : 0;
  EXPECT_GE(found, 13);  // a source in the border's corner is out of reach of a step ahead: about one in twenty
}

TYPED_TEST(Believers, KeepToTheirDomainWhereverItLies) {
  const NorthEast corner = at(100'000, -50'000);
  const sonar::SnrCurve curve = one_decibel_per_kilometer();
  PriorKnowledge prior = prior_with(curve);
  prior.settings.domain = {corner, corner + at(25'000, 25'000)};
  search::SearchSettings settings = prior.settings;
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::inside_border(settings);
  const search::World world(settings, curve);
  TypeParam searcher(prior);
  for (const evaluate::Flight& flight : evaluate::fly(searcher, world, {.end = 3}, 1))
    EXPECT_NE(flight.record.end, search::EpisodeEnd::kLeftDomain);
}

}  // namespace
}  // namespace earshot::baselines
