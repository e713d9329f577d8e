#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/outage/temporary_folders_on_disk.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {

/// earshotd at sea with a policy that walks at random in steps of 20 m, in a folder of the test's own, which stays when the test fails.
class WalkAtSea : public testing::Test {
 protected:
  WalkAtSea() {
    policy::FrozenPolicy walk = support::random_walk_policy();
    walk.step_length = Meters{20};
    support::write_bytes(folder_ / "walk.policy", support::signed_bytes(walk));
    support::write_public_key(folder_ / "walk.pub");
  }
  ~WalkAtSea() override {
    if (HasFailure()) folder_.keep();
  }

  static void replace(std::string& text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }

  /// One of the missions that ship, with steps of 1 s instead of 500 s, ten turns of the loop a second, and the walk's own listening.
  [[nodiscard]] static std::string mission_of_short_steps(const std::string& name) {
    std::string mission = support::read_text(std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions" / name);
    replace(mission, "step_length_m = 1000.0", "step_length_m = 20.0");
    replace(mission, "speed_mps = 2.0", "speed_mps = 20.0");
    replace(mission, "step_period_s = 1.0", "step_period_s = 0.1");
    replace(mission, "listening = \"mean\"", "listening = \"newest\"");
    replace(mission, "listening_window_s = 30", "listening_window_s = 0");
    return mission;
  }

  /// No stall of this computer reaches these: it may be silent for 300 s.
  [[nodiscard]] static std::string patient(std::string mission) {
    replace(mission, "navigation_timeout_s = 5.0", "navigation_timeout_s = 300.0");
    replace(mission, "snr_timeout_s = 5.0", "snr_timeout_s = 300.0");
    return mission;
  }

  void write_mission(const std::string& mission) const { std::ofstream(folder_ / "mission.toml") << mission; }

  void start_earshotd(const std::vector<std::string>& more) {
    std::vector<std::string> a{folder_ / "mission.toml", "--policy", folder_ / "walk.policy", "--public-key",
                               folder_ / "walk.pub",     "--out",    folder_.path()};
    a.insert(a.end(), more.begin(), more.end());
    earshotd_ = std::make_unique<support::Process>(std::filesystem::path(EARSHOT_BIN_DIR) / "earshotd", a, folder_ / "earshotd.txt");
  }

  const TemporaryFoldersOnDisk on_disk_{};
  support::TemporaryFolder folder_;
  std::unique_ptr<support::Process> earshotd_;
};

}  // namespace earshot
