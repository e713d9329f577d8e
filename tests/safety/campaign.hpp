#pragma once

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/program/run.hpp"

namespace earshot::campaign {

/// Which missions are flown: one for each seed.
struct CampaignOptions {
  std::uint64_t missions = 100'000;
  std::uint64_t seed = 1;
  std::uint32_t threads = 2;

  void add_to(program::CommandLine& line) {
    line.option("--missions", &missions, "how many").from(1, 100'000'000).shows_default();
    line.option("--seed", &seed, "of the first; each is a mission").shows_default();
    line.option("--threads", &threads, "how many fly at once").from(1, 64).shows_default();
  }
};

/// Calls fly(seed) for each mission, so many at once as the options say.
template <class Fly>
void fly_each(const CampaignOptions& options, Fly fly) {
  std::atomic<std::uint64_t> next{0};
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < options.threads; ++t) {
    threads.emplace_back([&] {
      for (std::uint64_t i = next++; i < options.missions; i = next++) fly(options.seed + i);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

/// Prints the first missions in which something was not held. @param broken  what, by seed   @return the program's exit status
inline int print_broken(const std::map<std::uint64_t, std::string>& broken) {
  constexpr int kNotHeld = 1;
  constexpr std::size_t kMostShown = 20;
  std::size_t shown = 0;
  for (const auto& [seed, words] : broken) {
    if (++shown > kMostShown) break;
    std::printf("  --seed %llu --missions 1: %s\n", static_cast<unsigned long long>(seed), words.c_str());
  }
  return broken.empty() ? program::kDone : kNotHeld;
}

}  // namespace earshot::campaign
