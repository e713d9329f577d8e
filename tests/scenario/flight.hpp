#pragma once

#include <gtest/gtest.h>

#include <unistd.h>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "sim/link/run_slot.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

inline const fs::path kSource = EARSHOT_SOURCE_DIR;
inline const fs::path kBin = EARSHOT_BIN_DIR;
inline const fs::path kMission = kSource / "firmware/boards/linux/missions/fixed_source.toml";
inline const fs::path kEnvironment = kSource / "sim/ocean/environments/munk_flat.toml";

/// A folder of its own, in which flights are made with a policy that walks at random.
class Flight : public testing::Test {
 protected:
  void SetUp() override {
    support::write_bytes(folder_ / "walk.policy", support::signed_bytes(support::random_walk_policy()));
    support::write_public_key(folder_ / "walk.pub");
  }
  void TearDown() override {
    if (HasFailure()) folder_.keep();
  }

  [[nodiscard]] std::vector<std::string> policy_arguments() const {
    return {"--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub"};
  }

  /// The mission flies so many steps, not 100, for where more show nothing: a flight's every second passes between three processes.
  void shorten_to(int steps) {
    std::string mission = support::read_text(kMission);
    const std::string hundred = "max_steps = 100";
    ASSERT_NE(mission.find(hundred), std::string::npos);
    mission.replace(mission.find(hundred), hundred.size(), "max_steps = " + std::to_string(steps));
    mission_ = folder_ / "mission.toml";
    std::ofstream(mission_) << mission;
  }

  /// A flight by earshot-fly with a policy that walks at random.
  [[nodiscard]] std::unique_ptr<support::Process> fly(const std::string& out, std::vector<std::string> more,
                                                      const fs::path& environment = kEnvironment) const {
    std::vector<std::string> a = policy_arguments();
    a.insert(a.end(), {"--environment", environment, "--mission", mission_, "--out", folder_ / out, "--no-report"});
    a.insert(a.end(), more.begin(), more.end());
    return std::make_unique<support::Process>(kBin / "earshot-fly", a, folder_ / (out + ".txt"));
  }

  /// Both processes of one flight without earshot-fly between them and the test.
  void start_both() {
    const std::string domain = std::to_string(slot_.domain());
    std::vector<std::string> a = policy_arguments();
    a.insert(a.end(), {mission_, "--out", folder_.path(), "--simulation", domain, "--lcm-url", slot_.lcm_url()});
    runtime_ = std::make_unique<support::Process>(kBin / "earshotd", a, folder_ / "earshotd.txt");
    simulator_ = std::make_unique<support::Process>(
        kBin / "earshot-sim",
        std::vector<std::string>{"--environment", kEnvironment, "--mission", mission_, "--out", folder_.path(), "--domain", domain,
                                 "--lcm-url", slot_.lcm_url(), "--ignore-source", "--speed", "500"},
        folder_ / "earshot-sim.txt");
  }

  /// Until the journal holds some minutes at sea.
  [[nodiscard]] bool is_under_way(const std::string& out = ".") const {
    for (const auto deadline = std::chrono::steady_clock::now() + 30s; std::chrono::steady_clock::now() < deadline;) {
      for (const fs::path& journal : {folder_ / out / "journal.lcmlog", folder_ / out / "unfinished-flight/journal.lcmlog"}) {
        std::error_code error;
        if (fs::exists(journal) && fs::file_size(journal, error) > 50'000) return true;
      }
      std::this_thread::sleep_for(20ms);
    }
    return false;
  }

  /// Until there is a journal, whatever its name: its mission is on the bus.
  [[nodiscard]] bool has_journal() const {
    for (const auto deadline = std::chrono::steady_clock::now() + 10s; std::chrono::steady_clock::now() < deadline;) {
      for (const auto& file : fs::directory_iterator(folder_)) {
        if (file.path().extension() == ".lcmlog") return true;
      }
      std::this_thread::sleep_for(20ms);
    }
    return false;
  }

  struct Contents {
    std::size_t records = 0;
    host::JournalReader::End end = host::JournalReader::End::kCorrupt;
  };
  [[nodiscard]] Contents journal(const std::string& out = ".") const {
    host::JournalReader reader(folder_ / out / "journal.lcmlog");
    Contents contents;
    for (host::JournalRecord record; reader.next(record);) ++contents.records;
    contents.end = reader.end();
    return contents;
  }

  [[nodiscard]] nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(support::read_text(folder_ / out / "summary.json"));
  }

  support::TemporaryFolder folder_;
  fs::path mission_ = kMission;
  const link::RunSlot slot_;
  std::unique_ptr<support::Process> runtime_;
  std::unique_ptr<support::Process> simulator_;
};

}  // namespace earshot
