// What earshot emulate refuses; tests/scenario/sea_over_can_test.cpp lets it sail.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
const std::filesystem::path kMissions = std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions";

class Emulate : public testing::Test {
 protected:
  void expect_refused(const std::vector<std::string>& arguments, const std::string& says) const {
    support::Process emulate(std::filesystem::path(EARSHOT_BIN_DIR) / "earshot-emulate", arguments, folder_ / "output.txt");
    EXPECT_EQ(emulate.wait(60s), 2);
    EXPECT_NE(emulate.output().find(says), std::string::npos) << emulate.output();
  }

  support::TemporaryFolder folder_;
};

TEST_F(Emulate, RefusesAMissionWithoutABusUnlessOneIsNamed) {
  expect_refused({"--mission", kMissions / "search.toml"}, "search.toml: port: no port is of the kind \"can\"; --interface names a bus");
}

TEST_F(Emulate, RefusesPlacesOutsideTheMissionsArea) {
  const std::vector<std::string> mission{"--mission", kMissions / "search_over_can.toml"};
  for (const std::string option : {"--source", "--start"}) {
    std::vector<std::string> arguments = mission;
    arguments.insert(arguments.end(), {option, "10000,25001"});
    expect_refused(arguments, option + ": must lie in the mission's [area]");
  }
}

TEST_F(Emulate, RefusesANameThatNoInterfaceCanHave) {
  expect_refused({"--mission", kMissions / "search_over_can.toml", "--interface", "a name that is far too long"},
                 "CAN interface a name that is far too long");
}

TEST_F(Emulate, AddsItsTrackToNoFileThatItReadsNorToOneThatIsNoTrack) {
  const auto file = [this](const char* name) { return (folder_ / name).string(); };
  std::filesystem::copy_file(kMissions / "search_over_can.toml", file("mission.toml"));
  std::filesystem::copy_file(std::filesystem::path(EARSHOT_SOURCE_DIR) / "sim/ocean/environments/munk_flat.toml", file("ocean.toml"));
  std::filesystem::create_hard_link(file("ocean.toml"), file("hard.csv"));
  std::ofstream(file("notes.csv")) << "my own notes\n";
  const std::vector<std::vector<std::string>> refused{
      {"mission.toml", "--mission " + file("mission.toml") + ", --track ", "same file"},
      {"hard.csv", "a file of --environment " + file("ocean.toml") + ", --track ", "same file"},
      {"notes.csv", "is there already and is not a track of earshot emulate; name another file"}};
  for (const std::vector<std::string>& each : refused) {
    const std::string before = support::read_text(file(each.front().c_str()));
    for (std::size_t i = 1; i < each.size(); ++i)
      expect_refused({"--mission", file("mission.toml"), "--environment", file("ocean.toml"), "--track", file(each.front().c_str())},
                     each[i]);
    EXPECT_EQ(support::read_text(file(each.front().c_str())), before);
  }
}

TEST_F(Emulate, RefusesADeviceThatItDoesNotHave) {
  expect_refused({"--mission", kMissions / "search_over_can.toml", "--without", "compass,rudder"}, "rudder");
}

}  // namespace
}  // namespace earshot
