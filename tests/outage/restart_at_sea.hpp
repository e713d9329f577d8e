#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/transport/lcm_url.hpp"
#include "tests/scenario/vehicle_over_lcm.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/private_network.hpp"

namespace earshot {

/// A vehicle whose earshotd was killed, or stopped, in mid-search and is started again, as its service does.
class RestartAtSea : public WalkAtSea {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    std::string mission = patient(mission_of_short_steps("search.toml"));
    replace(mission, "speed_mps = 20.0", "speed_mps = 2.0");  // the rule that wants progress waits for seconds
    write_mission(mission);
    vehicle_.emplace(std::string(host::kDefaultLcmUrl));
  }

  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"--resume", "--speed", "10"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    start_earshotd(arguments);
  }

  using Environment = std::vector<std::pair<const char*, std::string>>;
  void start_with(const Environment& environment) {
    for (const auto& [name, value] : environment) ::setenv(name, value.c_str(), 1);
    start();
    for (const auto& [name, value] : environment) ::unsetenv(name);
  }
  /// @param environment  what sick_host reads
  void start_on_sick_host(Environment environment) {
    environment.emplace_back("LD_PRELOAD", EARSHOT_SICK_HOST);
    start_with(environment);
  }

  /// GIVEN a search under way that a power cut, or a crash, ends.
  void search(const Environment& environment = {}) {
    start_with(environment);
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->turns > 5; })) << earshotd_->output();
    vehicle_->order(messages::Order::kStart);
    ASSERT_TRUE(vehicle_->sails_until([&] {
      return vehicle_->state() == messages::MissionState::kSearch && vehicle_->health.steps_taken > 0;
    })) << earshotd_->output();
  }
  /// As a person, or a computer that shuts down, does.
  void stop() {
    earshotd_->signal(SIGTERM);
    int status = -1;
    EXPECT_TRUE(vehicle_->sails_until([&] { return (status = earshotd_->wait(std::chrono::milliseconds(0))) != -1; }))
        << earshotd_->output();
    EXPECT_TRUE(status == program::kInterrupted || status == program::kAborted) << status << earshotd_->output();
    int rounds = 0;
    EXPECT_TRUE(vehicle_->sails_until([&] { return ++rounds > 20; })) << "what it said last has been heard";
    vehicle_->health = {};
  }
  void kill() {
    earshotd_->signal(SIGKILL);
    (void)earshotd_->wait(std::chrono::seconds(10));
    vehicle_->health = {};
  }

  /// The vehicle is told to stop and come up. (Within ten seconds: `outages`, where it may be measured.)
  void expect_comes_up() {
    EXPECT_TRUE(vehicle_->sails_until([&] {
      return vehicle_->state() == messages::MissionState::kAbort && vehicle_->depth() == Meters{0.0};
    })) << earshotd_->output();
    EXPECT_EQ(earshotd_->wait(std::chrono::milliseconds(0)), -1) << "it goes on until it is stopped" << earshotd_->output();
  }

  /// Started again, and told to come up while its journal is read.
  void start_with_slow_reading() {
    start_on_sick_host({{"EARSHOT_TEST_READING_S", "12"}});
    const int setpoints = vehicle_->setpoints;
    ASSERT_TRUE(vehicle_->sails_until([&] { return vehicle_->setpoints > setpoints; })) << earshotd_->output();
    EXPECT_FALSE(is_printed("goes on from")) << "before it has been read";
    EXPECT_EQ(vehicle_->depth(), Meters{0.0});
    EXPECT_EQ(vehicle_->state(), messages::MissionState::kSearch);
  }
  [[nodiscard]] bool is_printed(std::string_view words) const { return earshotd_->output().find(words) != std::string::npos; }
  [[nodiscard]] std::filesystem::path journal() const { return folder_ / "journal.lcmlog"; }

  /// Started again with the journal's folder elsewhere.
  void start_in(const std::filesystem::path& out) {
    earshotd_ = std::make_unique<support::Process>(
        std::filesystem::path(EARSHOT_BIN_DIR) / "earshotd",
        std::vector<std::string>{folder_ / "mission.toml", "--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub",
                                 "--out", out, "--resume", "--speed", "10"},
        folder_ / "earshotd.txt");
  }

  std::optional<VehicleOverLcm> vehicle_;  ///< in the test's own network
};

}  // namespace earshot
