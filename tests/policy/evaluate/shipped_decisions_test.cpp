#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/policy/network.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/world_file.hpp"
#include "policy/explain/network_gradient.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::evaluate {
namespace {

const std::filesystem::path kSource = EARSHOT_SOURCE_DIR;
constexpr std::size_t kObservations = 10'000;
// What one may expect of float for logits that reach 16: 64 sums that round by half of 1e-6 each, hardly ever all the same way.
constexpr double kTolerance = 5e-6;

/// Searches as the policy does, and keeps what it saw.
class Recorder : public baselines::Searcher {
 public:
  explicit Recorder(const policy::FrozenPolicy& policy) : policy_(policy) {}

  void begin(Pcg32 random) override {
    random_ = random;
    is_first_ = true;
  }

  std::size_t choose(const baselines::DecisionInput& input) override {
    if (is_first_) {
      memory_.start(policy_.observation, no_oceans_, input.position, input.reception);
    } else {
      memory_.remember(policy_.observation, no_oceans_, input.position, input.reception);
    }
    is_first_ = false;
    std::vector<float>& seen = observations_.emplace_back(policy_.observation.spec.size());
    std::vector<float> logits(policy_.actions.size());
    policy::observe(memory_, policy_.observation, seen);
    policy::forward(policy_.network, seen, logits);
    return policy::draw_action(policy_.draw, logits, random_);
  }

  [[nodiscard]] const std::vector<std::vector<float>>& observations() const { return observations_; }

 private:
  const policy::FrozenPolicy& policy_;
  policy::SearchMemory memory_;
  policy::OceanTables no_oceans_;  // a policy that sees no belief needs none
  Pcg32 random_{0};
  bool is_first_ = true;
  std::vector<std::vector<float>> observations_;
};

/// What `policy` sees when it searches in some of the test worlds.
std::vector<std::vector<float>> observations_of(const policy::FrozenPolicy& policy) {
  Recorder recorder(policy);
  const std::array worlds{"paper", "noisy_4db", "duty_cycle", "all_at_once"};
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const WorldFile world = load_world(kSource / "policy/worlds" / (std::string(worlds[w]) + ".toml"));
    const search::SearchSettings settings = search_of(policy);
    search::World place = search::assemble(world.scenario, settings, Meters{300.0});
    place.actions = policy.actions;
    for (std::size_t i = 0; recorder.observations().size() < kObservations * (w + 1) / worlds.size(); ++i) {
      static_cast<void>(fly(recorder, place, {.end = i + 1, .first = i}, world.seed));
    }
  }
  return recorder.observations();
}

/// Of the one that ships with a network.
TEST(ShippedDecisions, AreThoseOfDoublePrecision) {
  const auto policy = host::load_unverified_policy(kSource / "policy/frozen/fixed_source.policy");
  double largest_error = 0.0;
  std::size_t differing = 0;
  const std::vector<std::vector<float>> observations = observations_of(*policy);
  ASSERT_GE(observations.size(), kObservations);
  for (const std::vector<float>& observation : observations) {
    std::vector<float> logits(policy->actions.size());
    policy::forward(policy->network, observation, logits);
    const std::vector<double> exact = explain::logits_of(policy->network, std::vector<double>(observation.begin(), observation.end()));
    for (std::size_t i = 0; i < logits.size(); ++i) largest_error = std::max(largest_error, std::abs(double{logits[i]} - exact[i]));
    const auto chosen = static_cast<std::size_t>(std::ranges::max_element(logits) - logits.begin());
    const auto best = static_cast<std::size_t>(std::ranges::max_element(exact) - exact.begin());
    if (chosen == best) continue;
    ++differing;
    EXPECT_LE(exact[best] - exact[chosen], kTolerance)
        << "action " << chosen << " with " << exact[chosen] << " instead of " << best << " with " << exact[best];
  }
  EXPECT_LE(largest_error, kTolerance);
  std::printf("%zu observations, largest error of a logit %.3g, %zu other decisions\n", observations.size(), largest_error, differing);
}

}  // namespace
}  // namespace earshot::evaluate
