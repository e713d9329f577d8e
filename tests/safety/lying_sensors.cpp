// Missions whose sensors lie, each flown to its end and until the vehicle has come up.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/program/run.hpp"
#include "tests/safety/lying_flight.hpp"

namespace earshot::campaign {
namespace {

constexpr int kNotHeld = 1;  ///< exit status: something of what is promised was not held
constexpr std::size_t kMostShown = 20;

struct Options {
  std::uint64_t missions = 100'000;
  std::uint64_t seed = 1;
  std::uint32_t threads = 2;
  bool honest = false;
};

class Campaign {
 public:
  explicit Campaign(const Options& options) : options_(options) {}

  int run() {
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < options_.threads; ++i) threads.emplace_back([this] { fly_all(); });
    for (std::thread& thread : threads) thread.join();
    std::printf("%-24s %9s\n", "ended by", "missions");
    for (const auto& [ended, count] : ended_) std::printf("%-24s %9llu\n", ended.c_str(), static_cast<unsigned long long>(count));
    std::printf("beyond the halt polygon, at most %.0f m (--seed %llu)\n", most_beyond_m_,
                static_cast<unsigned long long>(most_beyond_seed_));
    std::printf("%llu missions: %zu broke a promise\n", static_cast<unsigned long long>(options_.missions), broken_.size());
    std::size_t shown = 0;
    for (const auto& [seed, words] : broken_) {
      if (++shown > kMostShown) break;
      std::printf("  --seed %llu --missions 1: %s\n", static_cast<unsigned long long>(seed), words.c_str());
    }
    return broken_.empty() ? program::kDone : kNotHeld;
  }

 private:
  void fly_all() {
    for (std::uint64_t i = next_++; i < options_.missions; i = next_++) {
      const std::uint64_t seed = options_.seed + i;
      const LyingMission mission = draw_lying(seed, options_.honest);
      const LyingResult result = fly_lying(mission);
      const std::lock_guard lock(mutex_);
      ++ended_[result.alarm ? std::string(config::kConditionTraits.at(static_cast<std::size_t>(*result.alarm)).key) : "ABORT"];
      if (result.beyond_halt_m > most_beyond_m_) {
        most_beyond_m_ = result.beyond_halt_m;
        most_beyond_seed_ = seed;
      }
      if (!result.broken.empty())
        broken_[seed] =
            result.broken + " (" + words_of(mission) +
            (result.alarm ? std::string(", ") + std::string(config::kConditionTraits.at(static_cast<std::size_t>(*result.alarm)).key) +
                                " at " + std::to_string(result.alarm_s) + " s"
                          : "") +
            ")";
    }
  }

  Options options_;
  std::atomic<std::uint64_t> next_{0};
  std::mutex mutex_;
  std::map<std::string, std::uint64_t> ended_;
  std::map<std::uint64_t, std::string> broken_;
  double most_beyond_m_ = 0.0;
  std::uint64_t most_beyond_seed_ = 0;
};

}  // namespace
}  // namespace earshot::campaign

int main(int argc, char** argv) {
  using namespace earshot;
  campaign::Options options;
  program::CommandLine line(
      "lying_sensors",
      "lying_sensors flies random missions in which one or two sensors lie from some moment on (or, with --honest, none does), aborts "
      "them,\n"
      "and holds each against what the safety supervisor promises: the vehicle comes up, and is never far beyond the halt polygon.\n"
      "Exit status: 0 all was kept; 1 something was not.");
  line.option("--missions", &options.missions, "how many").from(1, 100'000'000).shows_default();
  line.option("--seed", &options.seed, "of the first; each is a mission").shows_default();
  line.option("--threads", &options.threads, "how many fly at once").from(1, 64).shows_default();
  line.flag("--honest", &options.honest, "nobody lies, and no rule may act");
  return program::run(line, argc, argv, [&] { return campaign::Campaign(options).run(); });
}
