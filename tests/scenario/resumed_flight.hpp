#pragma once

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/scenario/flight.hpp"

namespace earshot {

/// A flight of some steps whose runtime is killed and goes on from its journal.
class ResumedFlight : public Flight {
 protected:
  explicit ResumedFlight(int steps = 12) : steps_(steps) {}

  void SetUp() override {
    Flight::SetUp();
    shorten_to(steps_);
  }

  void fly_whole() {
    start_runtime("whole");
    start_simulator("whole");
    ASSERT_EQ(simulator_->wait(120s), 0) << simulator_->output();
    ASSERT_EQ(runtime_->wait(10s), 0) << runtime_->output();
  }
  /// Once so many decisions stand in the journal; then it is started again.
  void kill_runtime_after(const std::string& out, int decisions) {
    ASSERT_TRUE(has_decided(out, decisions)) << runtime_->output();
    runtime_->signal(SIGKILL);
    (void)runtime_->wait(5s);
    start_runtime(out);
  }
  /// The flight ends, and nobody who looks at what it wrote could tell that its runtime was killed.
  void expect_same_as_whole(const std::string& out) {
    ASSERT_EQ(simulator_->wait(120s), 0) << simulator_->output();
    ASSERT_EQ(runtime_->wait(10s), 0) << runtime_->output();
    EXPECT_NE(runtime_->output().find("goes on from "), std::string::npos) << runtime_->output();
    EXPECT_TRUE(said(out) == said("whole"));
    EXPECT_TRUE(board::replay(folder_ / out / "journal.lcmlog").is_same());
    EXPECT_EQ(support::read_text(folder_ / (out + "-sim") / "track.csv"), support::read_text(folder_ / "whole-sim/track.csv"));
  }

  void start_runtime(const std::string& out, std::vector<std::string> more = {"--resume"}) {
    std::vector<std::string> a = policy_arguments();
    a.insert(a.end(), {mission_, "--out", folder_ / out, "--simulation", std::to_string(slot_.domain()), "--lcm-url", slot_.lcm_url()});
    a.insert(a.end(), more.begin(), more.end());
    runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / ("earshotd-" + std::to_string(++starts_) + ".txt"));
  }
  void start_simulator(const std::string& out) {
    simulator_ = std::make_unique<support::Process>(
        kBin / "earshot-sim",
        std::vector<std::string>{"--environment", environment_, "--mission", mission_, "--out", folder_ / (out + "-sim"), "--domain",
                                 std::to_string(slot_.domain()), "--lcm-url", slot_.lcm_url(), "--ignore-source", "--wait-for-runtime",
                                 "20"},
        folder_ / (out + "-sim.txt"));
  }

  /// Of the whole flight, but for what says that it was gone on with.
  [[nodiscard]] std::vector<std::pair<std::string, std::vector<std::uint8_t>>> said(const std::string& out) const {
    host::JournalReader reader(folder_ / out / "journal.lcmlog");
    std::vector<std::pair<std::string, std::vector<std::uint8_t>>> records;
    for (host::JournalRecord record; reader.next(record);) {
      if (record.channel != wire::kJournalResumedChannel) records.emplace_back(record.channel, record.data);
    }
    EXPECT_EQ(reader.end(), host::JournalReader::End::kWhole);
    return records;
  }

  /// Until this many decisions stand in the journal.
  [[nodiscard]] bool has_decided(const std::string& out, int decisions) const {
    const fs::path journal = folder_ / out / "journal.lcmlog";
    for (int i = 0; i < 3000 && !fs::exists(journal); ++i) std::this_thread::sleep_for(5ms);
    host::JournalReader reader(journal);
    for (const auto deadline = std::chrono::steady_clock::now() + 120s; std::chrono::steady_clock::now() < deadline;) {
      for (host::JournalRecord record; reader.next(record);) {
        if (record.channel == wire::kDecisionChannel && --decisions == 0) return true;
      }
      reader.resume_reading();
      std::this_thread::sleep_for(1ms);
    }
    return false;
  }

  fs::path environment_ = kEnvironment;

 private:
  int steps_;
  int starts_ = 0;
};

}  // namespace earshot
