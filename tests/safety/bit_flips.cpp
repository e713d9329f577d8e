// Single bits that flip in a runtime's memory in the midst of a mission: no limit may be broken in the minute after.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/program/run.hpp"
#include "tests/safety/flipped_flight.hpp"

namespace earshot::campaign {
namespace {

constexpr int kNotHeld = 1;  ///< exit status: something of what is promised was not held
constexpr std::size_t kMostShown = 20;
/// Of one mission, at one moment; each in a copy of it.
constexpr std::uint64_t kFlipsOfMission = 50;

struct Options {
  std::uint64_t flips = 100'000;
  std::uint64_t seed = 1;
  std::uint32_t threads = 2;
};

struct Tally {
  std::uint64_t flips = 0;
  std::uint64_t noticed = 0;
};

class Campaign {
 public:
  explicit Campaign(const Options& options) : options_(options) {}

  int run() {
    const auto began = std::chrono::steady_clock::now();
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < options_.threads; ++i) threads.emplace_back([this] { flip_all(); });
    for (std::thread& thread : threads) thread.join();
    const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    std::printf("%-36s %9s %9s\n", "in", "flips", "noticed");
    for (const auto& [part, tally] : tallies_) {
      std::printf("%-36s %9llu %8.1f%%\n", part.c_str(), static_cast<unsigned long long>(tally.flips),
                  100.0 * static_cast<double>(tally.noticed) / static_cast<double>(tally.flips));
    }
    std::printf("%llu flips in %.0f s: %zu broke a promise\n", static_cast<unsigned long long>(options_.flips), took_s, broken_.size());
    std::size_t shown = 0;
    for (const auto& [place, words] : broken_) {
      if (++shown > kMostShown) break;
      std::printf("  mission %llu, bit %llu: %s\n", static_cast<unsigned long long>(place.first),
                  static_cast<unsigned long long>(place.second), words.c_str());
    }
    return broken_.empty() ? program::kDone : kNotHeld;
  }

 private:
  void flip_all() {
    const std::uint64_t missions = (options_.flips + kFlipsOfMission - 1) / kFlipsOfMission;
    for (std::uint64_t i = next_++; i < missions; i = next_++) flip_in(options_.seed + i, i);
  }

  void flip_in(std::uint64_t seed, std::uint64_t index) {
    FlippedFlight flight(seed);
    Pcg32 random(seed, 23);
    for (std::uint64_t k = 0; k < kFlipsOfMission && index * kFlipsOfMission + k < options_.flips; ++k) {
      // Half of them where a bit decides about the vehicle.
      const Part part = k % 2 == 0 ? Part::kDecisive : Part::kAnywhere;
      const std::uint64_t bit = flight.drawn_bit(part, random.uniform_double());
      const FlipResult result = flight.fly_with(bit);
      const std::lock_guard lock(mutex_);
      Tally& tally = tallies_[std::string(flight.name_of(bit))];
      ++tally.flips;
      if (result.is_noticed) ++tally.noticed;
      if (!result.broken.empty()) broken_[{seed, bit}] = result.broken;
    }
  }

  Options options_;
  std::atomic<std::uint64_t> next_{0};
  std::mutex mutex_;
  std::map<std::string, Tally> tallies_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::string> broken_;
};

}  // namespace
}  // namespace earshot::campaign

int main(int argc, char** argv) {
  using namespace earshot;
  campaign::Options options;
  program::CommandLine line("bit_flips",
                            "bit_flips flips single bits of a runtime in the midst of random missions, and flies on for a minute.\n"
                            "Exit status: 0 no limit was broken; 1 one was.");
  line.option("--flips", &options.flips, "how many, one at a time").from(1, 100'000'000).shows_default();
  line.option("--seed", &options.seed, "of the first mission").shows_default();
  line.option("--threads", &options.threads, "how many fly at once").from(1, 64).shows_default();
  return program::run(line, argc, argv, [&] { return campaign::Campaign(options).run(); });
}
