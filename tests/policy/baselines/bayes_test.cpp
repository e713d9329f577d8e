#include "policy/baselines/bayes.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "policy/baselines/genetic.hpp"
#include "policy/baselines/infotaxis.hpp"
#include "policy/baselines/moves.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "sim/search/actions/compass_directions.hpp"
#include "sim/search/known_ocean.hpp"
#include "tests/firmware/place.hpp"

namespace earshot::baselines {
namespace {

/// A searcher that is told of one ocean, and of the same one as ocean tables.
struct KnownTables {
  explicit KnownTables(sonar::SnrCurve known) : curve(std::move(known)) { search::make_known_ocean({}, curve, oceans); }
  [[nodiscard]] PriorKnowledge prior() const {
    return {.settings = {}, .actions = search::compass_directions(8), .snr = curve, .oceans = oceans};
  }
  sonar::SnrCurve curve;
  policy::OceanTables oceans;
};

/// 30 dB at the source, one less per kilometre.
sonar::SnrCurve one_decibel_per_kilometer() {
  std::vector<float> snr_db;
  for (int km = 0; km <= 40; ++km) snr_db.push_back(30.0F - static_cast<float>(km));
  return sonar::SnrCurve(Meters{1'000.0}, snr_db);
}

template <class Searcher>
class Believers : public testing::Test {};
using AllBelievers = testing::Types<Bayes, BayesLeastRegret, Infotaxis, Genetic>;
TYPED_TEST_SUITE(Believers, AllBelievers);

TYPED_TEST(Believers, FindNearlyAllSourcesInAnOceanThatTellsTheRange) {
  const KnownTables known(one_decibel_per_kilometer());
  const PriorKnowledge prior = known.prior();
  search::SearchSettings settings;
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::inside_border(settings);
  const search::World world(settings, known.curve);
  TypeParam searcher(prior);
  int found = 0;
  for (const evaluate::Flight& flight : evaluate::fly(searcher, world, {.end = 16}, 1))
    found += flight.record.end == search::EpisodeEnd::kFound ? 1 : 0;
  EXPECT_GE(found,
            13);  // of 100 they find 93, 99, 98; a source in the border's corner is out of reach of a step ahead: about one in twenty
}

TYPED_TEST(Believers, KeepToTheirDomainWhereverItLies) {
  const NorthEast corner = at(100'000, -50'000);
  const KnownTables known(one_decibel_per_kilometer());
  PriorKnowledge prior = known.prior();
  prior.settings.domain = {corner, corner + at(25'000, 25'000)};
  search::SearchSettings settings = prior.settings;
  settings.placement = search::SourcePlacement::kChanging;
  settings.start_region = search::inside_border(settings);
  const search::World world(settings, known.curve);
  TypeParam searcher(prior);
  for (const evaluate::Flight& flight : evaluate::fly(searcher, world, {.end = 3}, 1))
    EXPECT_NE(flight.record.end, search::EpisodeEnd::kLeftDomain);
}

}  // namespace
}  // namespace earshot::baselines
