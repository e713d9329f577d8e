// Random missions with faults, each flown to its end and held against what the supervisor promises.

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>

#include "firmware/host/program/run.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "tests/safety/campaign.hpp"
#include "tests/safety/flight.hpp"

namespace earshot::campaign {
namespace {

struct Tally {
  std::uint64_t flown = 0;
  std::uint64_t aborted = 0;
  std::uint64_t steered_back = 0;
  std::uint64_t steps = 0;
};

class Campaign {
 public:
  explicit Campaign(const CampaignOptions& options) : options_(options) {}

  int run() {
    const auto began = std::chrono::steady_clock::now();
    fly_each(options_, [this](std::uint64_t seed) { fly(seed); });
    const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    std::printf("%-22s %9s %9s %13s %9s\n", "fault", "missions", "aborted", "steered back", "steps");
    for (const auto& [fault, tally] : tallies_) {
      std::printf("%-22s %9llu %9llu %13llu %9llu\n", std::string(to_string(fault)).c_str(), static_cast<unsigned long long>(tally.flown),
                  static_cast<unsigned long long>(tally.aborted), static_cast<unsigned long long>(tally.steered_back),
                  static_cast<unsigned long long>(tally.steps));
    }
    std::printf("%llu missions, %.0f days at sea, in %.0f s: %zu broke a promise\n", static_cast<unsigned long long>(options_.missions),
                static_cast<double>(seconds_) / 86'400.0, took_s, broken_.size());
    return print_broken(broken_);
  }

 private:
  void fly(std::uint64_t seed) {
    const DrawnMission drawn = draw(seed);
    const FlightResult result = campaign::fly(drawn);
    const std::lock_guard lock(mutex_);
    Tally& tally = tallies_[drawn.fault];
    ++tally.flown;
    tally.steps += result.steps;
    if (result.state == messages::MissionState::kAbort) ++tally.aborted;
    if (result.was_steered_back) ++tally.steered_back;
    seconds_ += result.seconds;
    if (result.broken.empty()) return;
    broken_[seed] = result.broken + " (" + std::string(to_string(drawn.fault)) + " after " +
                    std::to_string(drawn.fault_after.us / 1'000'000) + " s of the search, " + std::string(drawn.policy_kind) + " policy, " +
                    std::to_string(result.seconds) + " s flown, " + messages::to_string(result.state) + ", " +
                    messages::to_string(result.end_reason) + ")";
  }

  CampaignOptions options_;
  std::mutex mutex_;
  std::map<Fault, Tally> tallies_;
  std::map<std::uint64_t, std::string> broken_;
  std::int64_t seconds_ = 0;
};

}  // namespace
}  // namespace earshot::campaign

int main(int argc, char** argv) {
  using namespace earshot;
  campaign::CampaignOptions options;
  program::CommandLine line(
      "random_missions",
      "random_missions flies random missions with faults of every input, on a vehicle that moves as its mission says,\n"
      "and holds each against what the safety supervisor promises.\n"
      "Exit status: 0 all was kept; 1 something was not.");
  options.add_to(line);
  return program::run(line, argc, argv, [&] { return campaign::Campaign(options).run(); });
}
