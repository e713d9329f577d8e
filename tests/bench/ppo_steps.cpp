// ppo.steps_per_s: training steps a second of the changing-source memory task at Stable-Baselines3's default settings, one thread.
// ppo.large_batch.steps_per_s: the same with minibatches of 2048, the whole rollout.
// ppo.many_environments.steps_per_s: with minibatches of 2048 and 64 environments, 256 steps of each in a rollout.
// A training that learns nothing is none.
// usage: bench_ppo_steps [large_batch|many_environments] [STEPS]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "policy/ppo/trainer.hpp"
#include "tests/bench/short_form.hpp"

namespace {

using namespace earshot;

/// Spherical spreading: the time a step takes does not depend on the values in the table. tests/bench/peers/sb3_ppo.py uses the same.
sonar::SnrCurve spherical_spreading() {
  std::vector<float> snr_db;
  for (int i = 0; i <= 4'000; ++i) snr_db.push_back(static_cast<float>(85.0 - 20.0 * std::log10(std::max(1.0, 10.0 * i))));
  return sonar::SnrCurve(Meters{10.0}, snr_db);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  const bool many_environments = first == "many_environments";
  const bool large_batch = first == "large_batch" || many_environments;
  const int next = large_batch ? 2 : 1;
  const std::uint64_t steps = argc > next ? std::strtoull(argv[next], nullptr, 10) : bench::full_or_short<std::uint64_t>(300'000, 4'096);
  ppo::HyperParameters hyper;
  if (bench::is_wrong_on_purpose()) hyper.learning_rate = 0.0;
  if (large_batch) hyper.batch_size = 2'048;
  if (many_environments) {
    hyper.environment_count = 64;
    hyper.steps_per_rollout = 256;
  }
  const sonar::SnrCurve curve = spherical_spreading();
  search::SearchSettings settings;
  settings.placement = search::SourcePlacement::kChanging;
  const search::World world(settings, curve);
  const policy::ObservationModel model{.spec = policy::memory_state(2, settings.step_length, settings.detection_threshold).value(),
                                       .belief = {}};
  const auto begin = std::chrono::steady_clock::now();
  const auto no_tables = std::make_unique<policy::OceanTables>();
  ppo::Trainer trainer(world, model, *no_tables, hyper, 1);
  const std::span<const float> parameters = trainer.networks().parameters();
  const std::vector<float> untrained(parameters.begin(), parameters.end());
  trainer.train(steps, [](const search::EpisodeRecord&, std::uint64_t) { return true; });
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  if (trainer.steps() < steps || std::ranges::equal(parameters, untrained) ||
      !std::ranges::all_of(parameters, [](float x) { return std::isfinite(x); })) {
    std::cerr << "nothing was learnt in " << trainer.steps() << " steps of " << steps << "\n";
    return 1;
  }
  std::cout << R"({"name": "ppo.)" << (large_batch ? std::string(first) + "." : "") << R"(steps_per_s", "value": )"
            << static_cast<double>(trainer.steps()) / elapsed.count() << R"(, "unit": "steps/s"})" << '\n';
}
