#include "policy/freeze/golden_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>

#include "firmware/host/policy/unverified_policy.hpp"
#include "tests/support/signed_policy.hpp"

namespace earshot::freeze {
namespace {

/// Both, so that a belief and none are seen.
std::vector<std::unique_ptr<policy::FrozenPolicy>> shipped() {
  std::vector<std::unique_ptr<policy::FrozenPolicy>> policies;
  for (const char* name : {"shipped.policy", "fixed_source.policy"})
    policies.push_back(host::load_unverified_policy(std::string(EARSHOT_SOURCE_DIR "/policy/frozen/") + name));
  return policies;
}

template <class Value>
auto all_steps(const policy::FrozenPolicy& policy, Value value) {
  std::vector<decltype(value(policy.golden[0][0]))> values;
  for (const policy::GoldenTrajectory& trajectory : policy.golden)
    for (const policy::GoldenStep& step : trajectory) values.push_back(value(step));
  return values;
}

TEST(GoldenSearch, HearsWhatIsMeasuredAndWhatIsTooFaint) {
  for (const auto& policy : shipped()) {
    const auto too_faint = all_steps(*policy, [](const policy::GoldenStep& step) { return step.reception.too_faint; });
    EXPECT_EQ(std::ranges::count(too_faint, true), 3);
    EXPECT_EQ(std::ranges::count(too_faint, false), 9);
  }
}

TEST(GoldenSearch, ComesToTheEdgeAndStaysInTheArea) {
  for (const auto& policy : shipped()) {
    const auto edge = all_steps(*policy, [&](const policy::GoldenStep& step) {
      const NorthEast far = policy->area_size - step.place;
      return std::min({step.place.north, step.place.east, far.north, far.east}).value;
    });
    EXPECT_GE(*std::ranges::min_element(edge), 0.0);
    EXPECT_LT(*std::ranges::min_element(edge), 1'000.0) << "in the border";
    EXPECT_GT(*std::ranges::max_element(edge), 5'000.0) << "and in the middle";
  }
}

TEST(GoldenSearch, GoesInSeveralDirections) {
  for (const auto& policy : shipped()) {
    std::set<std::pair<double, double>> ways;
    for (const policy::GoldenTrajectory& trajectory : policy->golden) {
      for (std::size_t i = 1; i < trajectory.size(); ++i) {
        const NorthEast way = trajectory[i].place - trajectory[i - 1].place;
        ways.emplace(std::round(way.north.value), std::round(way.east.value));
      }
    }
    EXPECT_GE(ways.size(), 4U);
  }
}

TEST(GoldenSearch, IsFlownAgainJustAsInThePoliciesThatShip) {
  for (const auto& policy : shipped()) {
    const auto golden = policy->golden;
    policy->golden = {};
    fly_golden_searches(*policy);
    for (std::size_t search = 0; search < config::kGoldenTrajectories; ++search) {
      for (std::size_t i = 0; i < config::kGoldenSteps; ++i) {
        EXPECT_EQ(policy->golden[search][i].place, golden[search][i].place) << search << ' ' << i;
        EXPECT_EQ(policy->golden[search][i].reception, golden[search][i].reception) << search << ' ' << i;
      }
    }
  }
}

TEST(GoldenSearch, HearsTheFirstGoldenOceanADecibelFainterForEveryRange) {
  policy::FrozenPolicy policy = support::random_walk_policy();  // 25 km by 25 km; the sources at (15, 17.5) and (20, 7.5) km
  fly_golden_searches(policy);
  const std::array<NorthEast, 2> sources{NorthEast{Meters{15'000.0}, Meters{17'500.0}}, NorthEast{Meters{20'000.0}, Meters{7'500.0}}};
  std::set<double> noises_db;
  for (std::size_t search = 0; search < 2; ++search) {
    for (const policy::GoldenStep& step : policy.golden[search]) {
      // 127 ranges over 50 km of sides, 50 dB at the source.
      const double modelled_db = 50.0 - std::floor(range_between(step.place, sources[search]).value * 127.0 / 50'000.0);
      noises_db.insert(step.reception.snr.value - modelled_db);
    }
  }
  EXPECT_EQ(noises_db.size(), 12U) << "noise, drawn anew at every step";
  EXPECT_GE(*noises_db.begin(), -3.0);
  EXPECT_LT(*noises_db.rbegin(), 3.0);
}

TEST(GoldenSearch, IsTheSameForTheSamePolicyAndRepeatedByThisBuild) {
  policy::FrozenPolicy once = support::random_walk_policy();
  policy::FrozenPolicy twice = support::random_walk_policy();
  fly_golden_searches(once);
  fly_golden_searches(twice);
  for (std::size_t i = 0; i < config::kGoldenSteps; ++i) EXPECT_EQ(once.golden[1][i].place, twice.golden[1][i].place);
  EXPECT_TRUE(policy::repeats_golden(once, *std::make_unique<policy::SearchMemory>(), *std::make_unique<policy::OceanTables>()));
}

}  // namespace
}  // namespace earshot::freeze
