// Missions whose sensors lie, each flown to its end and until the vehicle has come up.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>

#include "firmware/host/program/run.hpp"
#include "tests/safety/campaign.hpp"
#include "tests/safety/lying_flight.hpp"

namespace earshot::campaign {
namespace {

struct Options : CampaignOptions {
  bool honest = false;
};

class Campaign {
 public:
  explicit Campaign(const Options& options) : options_(options) {}

  int run() {
    fly_each(options_, [this](std::uint64_t seed) { fly(seed); });
    std::printf("%-24s %9s\n", "ended by", "missions");
    for (const auto& [ended, count] : ended_) std::printf("%-24s %9llu\n", ended.c_str(), static_cast<unsigned long long>(count));
    std::printf("beyond the halt polygon, at most %.0f m (--seed %llu)\n", most_beyond_m_,
                static_cast<unsigned long long>(most_beyond_seed_));
    std::printf("kept at the surface by its propeller, for a false depth goes on stating that it is below: %llu\n",
                static_cast<unsigned long long>(keep_coming_up_));
    std::printf("%llu missions: %zu broke a promise\n", static_cast<unsigned long long>(options_.missions), broken_.size());
    return print_broken(broken_);
  }

 private:
  void fly(std::uint64_t seed) {
    const LyingMission mission = draw_lying(seed, options_.honest);
    const LyingResult result = fly_lying(mission);
    const std::lock_guard lock(mutex_);
    ++ended_[result.alarm ? std::string(config::kConditionTraits.at(static_cast<std::size_t>(*result.alarm)).key) : "ABORT"];
    if (result.beyond_halt_m > most_beyond_m_) {
      most_beyond_m_ = result.beyond_halt_m;
      most_beyond_seed_ = seed;
    }
    if (result.keeps_coming_up) ++keep_coming_up_;
    if (!result.broken.empty())
      broken_[seed] =
          result.broken + " (" + words_of(mission) +
          (result.alarm ? std::string(", ") + std::string(config::kConditionTraits.at(static_cast<std::size_t>(*result.alarm)).key) +
                              " at " + std::to_string(result.alarm_s) + " s"
                        : "") +
          ")";
  }

  Options options_;
  std::mutex mutex_;
  std::map<std::string, std::uint64_t> ended_;
  std::map<std::uint64_t, std::string> broken_;
  std::uint64_t keep_coming_up_ = 0;
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
  options.add_to(line);
  line.flag("--honest", &options.honest, "nobody lies, and no rule may act");
  return program::run(line, argc, argv, [&] { return campaign::Campaign(options).run(); });
}
