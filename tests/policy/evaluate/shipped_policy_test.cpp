#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "policy/baselines/bayes.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/freeze/freeze.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::evaluate {
namespace {

const std::string kShipped = EARSHOT_SOURCE_DIR "/policy/frozen/shipped.policy";
const std::string kFixedSource = EARSHOT_SOURCE_DIR "/policy/frozen/fixed_source.policy";

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(ShippedPolicy, FindsTheFixedSourceOfThePapersOceanInNinetyNinePercentOfSearchesWithAMedianOfMinusThreeOrBetter) {
  const auto policy = host::load_unverified_policy(kFixedSource);
  const ocean::Environment environment = ocean::load_environment(EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml");
  const sonar::SnrCurve curve = sonar::compute_snr_curve(environment, Meters{300.0}, Meters{37'000.0});
  search::SearchSettings settings = search_of(*policy);
  settings.source = environment.source.position;
  const Summary summary = summarise(evaluate(*policy, policy::OceanTables{}, policy->draw, world_of(*policy, settings, curve), 300, 2026));
  EXPECT_GE(summary.found_fraction, 0.99);
  EXPECT_GE(summary.median_reward, -3.0);
}

/// The paper's search of a changing source, the ocean, and tables of one who is told of it.
struct GivenSearch {
  explicit GivenSearch(const policy::FrozenPolicy& policy) : settings(search_of(policy)) {
    settings.placement = search::SourcePlacement::kChanging;
    settings.start_region = search::inside_border(settings);
    search::make_known_ocean(settings, curve, *tables);
  }

  search::SearchSettings settings;
  const sonar::SnrCurve curve =
      sonar::compute_snr_curve(ocean::load_environment(EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml"), Meters{300.0},
                               search::furthest_range(settings));
  const std::unique_ptr<policy::OceanTables> tables = std::make_unique<policy::OceanTables>();
};

TEST(ShippedPolicy, FindsAChangingSourceOfThePapersOceanThatItIsToldOf) {
  const auto policy = host::load_unverified_policy(kShipped);
  const GivenSearch told(*policy);
  const Summary summary = summarise(evaluate(*policy, *told.tables, policy->draw, world_of(*policy, told.settings, told.curve), 40, 2026));
  EXPECT_GE(summary.found, 36U);  // 38; of 100 96
}

/// Without a network it is the belief's own advice that flies, whichever code asks for it.
TEST(ShippedPolicy, FliesAsTheBeliefsLeastRegretWhereItIsToldOfTheSameOcean) {
  const auto policy = host::load_unverified_policy(kShipped);
  ASSERT_FALSE(policy::has_network(policy->network));
  const GivenSearch told(*policy);
  const search::World world = world_of(*policy, told.settings, told.curve);
  const baselines::PriorKnowledge prior{.settings = told.settings, .actions = world.actions, .snr = told.curve, .oceans = *told.tables};
  baselines::BayesLeastRegret adviser(prior);
  const std::vector<Flight> advised = fly(adviser, world, {.end = 5}, 1);
  const std::vector<search::EpisodeRecord> flown = evaluate(*policy, *told.tables, policy->draw, world, 5, 1);
  for (std::size_t i = 0; i < flown.size(); ++i) {
    EXPECT_EQ(flown[i].steps, advised[i].record.steps) << i;
    EXPECT_EQ(flown[i].reward, advised[i].record.reward) << i;
    EXPECT_EQ(flown[i].end, advised[i].record.end) << i;
  }
}

TEST(ShippedPolicy, IsSignedByTheShippedPublicKey) {
  const std::string key_file = EARSHOT_SOURCE_DIR "/policy/frozen/earshot.pub";
  for (const std::string& file : {kShipped, kFixedSource}) {
    const std::string bytes = bytes_of(file);
    const std::vector<std::uint8_t> raw(bytes.begin(), bytes.end());
    EXPECT_TRUE(host::is_signed_at_end(raw, host::load_public_key(key_file).key)) << file;
  }
}

}  // namespace
}  // namespace earshot::evaluate
