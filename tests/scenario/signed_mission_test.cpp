// GIVEN a vehicle that flies signed missions alone, WHEN missions are signed ashore and flown at sea, THEN no other is.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "firmware/host/trust/mission_counter.hpp"
#include "tests/firmware/for_no_root.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_mission.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class SignedMissions : public testing::Test {
 protected:
  SignedMissions() {
    mission_.write(support::mission_of_the_walk(support::read_text(EARSHOT_SOURCE_DIR "/firmware/boards/linux/missions/search.toml")));
  }

  [[nodiscard]] support::Process start(const std::string& program, const Words& words, const std::string& said = "said.txt") const {
    return {fs::path(EARSHOT_BIN_DIR) / program, words, {.folder = folder_, .output = folder_ / "out.txt", .errors = folder_ / said}};
  }
  int run(const std::string& program, const Words& words) { return start(program, words).wait(10s); }
  [[nodiscard]] std::string said() const { return mission_.content("said.txt"); }
  [[nodiscard]] std::string printed() const { return mission_.content("out.txt"); }
  void expect_refused(const std::string& program, const Words& words, const std::string& why) {
    EXPECT_EQ(run(program, words), 2) << said();
    EXPECT_NE(said().find(why), std::string::npos) << why << " is not in: " << said();
    EXPECT_EQ(std::ranges::count(said(), '\n'), 1) << said();
  }

  int sign(std::uint64_t counter) {
    return run("earshot-sign", {"--key", "ops.key", "--counter", std::to_string(counter), "mission.toml"});
  }
  int verify() { return run("earshot-verify", {"--vehicle", "vehicle.toml", "mission.toml"}); }
  [[nodiscard]] std::uint64_t flown_last() const { return host::read_flown_last(folder_ / "mission.counter").counter; }

  /// At sea until its journal has begun; then a person ends it.
  int fly_for_a_moment() {
    const auto is_begun = [this](const fs::directory_entry& entry) {
      return entry.path().extension() == ".lcmlog" && entry.file_size() > 0 && !flown_.contains(entry.path());
    };
    support::Process earshotd = start("earshotd", kFly);
    for (const auto deadline = std::chrono::steady_clock::now() + 30s; std::chrono::steady_clock::now() < deadline;) {
      const auto found = std::find_if(fs::directory_iterator(folder_), fs::directory_iterator(), is_begun);
      if (found != fs::directory_iterator()) {
        flown_.insert(found->path());
        break;
      }
      if (const int status = earshotd.wait(10ms); status >= 0) return status;
    }
    earshotd.signal(SIGTERM);
    return earshotd.wait(30s);
  }

  const Words kFly{"--vehicle", "vehicle.toml", "mission.toml", "--out", "."};
  const support::TemporaryFolder folder_;
  const support::SignedMission mission_{folder_};
  std::set<fs::path> flown_;
};

TEST_F(SignedMissions, AreFlownAndNeverAgainWhenALaterOneHasFlown) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  ASSERT_EQ(run("earshot-verify", {"--vehicle", "vehicle.toml", "--new-counter", "0"}), 0) << said();
  ASSERT_EQ(sign(5), 0) << said();
  EXPECT_EQ(fly_for_a_moment(), 0) << said();
  EXPECT_EQ(flown_last(), 5U);
  EXPECT_EQ(fly_for_a_moment(), 0) << "after a restart: " << said();
  ASSERT_EQ(sign(6), 0);
  EXPECT_EQ(fly_for_a_moment(), 0) << said();
  ASSERT_EQ(sign(5), 0);
  expect_refused("earshotd", kFly, "mission.toml.sig: counter 5 is rolled back: the vehicle has flown 6");
  EXPECT_EQ(flown_last(), 6U);
}

TEST_F(SignedMissions, AreFlownInSimulationByTheKeysOfTheVehicleAlone) {
  host::begin_counter(folder_ / "mission.counter", 3);
  ASSERT_EQ(mission_.content("mission.toml").find("public_key_file"), std::string::npos);
  const Words kFlight{"--mission", "mission.toml", "--vehicle", "vehicle.toml", "--out", "flight", "--no-report", "--quiet"};
  expect_refused("earshot-fly", kFlight, "mission.toml: is not signed");
  ASSERT_EQ(sign(4), 0) << said();
  EXPECT_EQ(start("earshot-fly", kFlight).wait(60s), 0) << said();
  EXPECT_EQ(flown_last(), 3U) << "no vehicle has moved";
}

TEST_F(SignedMissions, OfTwoProgramsOnOneVehicleOneFlies) {
  ENTER_PRIVATE_NETWORK_OR_SKIP();
  host::begin_counter(folder_ / "mission.counter", 0);
  ASSERT_EQ(sign(1), 0);
  const host::MissionCounter held(folder_ / "mission.counter");
  expect_refused("earshotd", kFly, "is writing into this folder");
  EXPECT_EQ(run("earshotd", {"--vehicle", "vehicle.toml", "--check", "mission.toml", "--out", "."}), 0) << said();
}

TEST_F(SignedMissions, AreFlownAsTheyStand) {
  host::begin_counter(folder_ / "mission.counter", 0);
  ASSERT_EQ(sign(1), 0);
  for (const Words& option : {Words{"--policy", "walk.policy"}, Words{"--public-key", "walk.pub"}, Words{"--seed", "2"},
                              Words{"--bus", "can"}, Words{"--lcm-url", "udpm://239.255.76.67:7668?ttl=0"},
                              Words{"--can-interface", "can1"}, Words{"--hydrophone-url", "udpm://239.255.76.67:7669?ttl=0"}}) {
    Words words = kFly;
    words.insert(words.end(), option.begin(), option.end());
    expect_refused("earshotd", words, option.front() + ": not with a vehicle's configuration");
  }
}

TEST_F(SignedMissions, AreTheOnlyOnesOfAVehicleThatAsksForThem) {
  host::begin_counter(folder_ / "mission.counter", 0);
  expect_refused("earshotd", kFly, "mission.toml: is not signed");
  expect_refused("earshotd", {"--vehicle", "none.toml", "mission.toml"}, "none.toml: no such file");
  EXPECT_EQ(flown_last(), 0U);
}

TEST_F(SignedMissions, DoNotUseUpTheCounterByOneSignatureUnlessAPersonSaysSoOnTheVehicle) {
  host::begin_counter(folder_ / "mission.counter", 4);
  ASSERT_EQ(sign(9'223'372'036'854'775'807U), 0);
  expect_refused("earshotd", kFly, "counter 9223372036854775807 is more than 4294967296 above 4");
  expect_refused("earshot-verify", {"--vehicle", "vehicle.toml", "mission.toml"}, "is more than 4294967296 above 4");
  ASSERT_EQ(sign(5'000'000'000U), 0);
  const Words raise{"--vehicle", "vehicle.toml", "mission.toml", "--raise-counter"};
  EXPECT_EQ(run("earshot-verify", {raise[0], raise[1], raise[2], raise[3], "4999999999"}), 0) << said();
  EXPECT_TRUE(support::has_line(printed(), {"mission.counter", "above 4999999999"})) << printed();
  expect_refused("earshot-verify", {raise[0], raise[1], raise[3], "9"}, "mission.counter: stands at 4999999999, and is raised only");
}

TEST_F(SignedMissions, AreNotFlownByAVehicleWhoseTrustOthersCanChange) {
  host::begin_counter(folder_ / "mission.counter", 0);
  ASSERT_EQ(sign(1), 0);
  const Words kCheck{"--vehicle", "vehicle.toml", "--check", "mission.toml", "--out", "."};
  const Words kSimulate{"--mission", "mission.toml", "--vehicle", "vehicle.toml", "--out", "flight", "--no-report", "--quiet"};
  for (const std::string name : {"vehicle.toml", "walk.pub", "ops.pub", "mission.counter"}) {
    fs::permissions(folder_ / name, fs::perms::group_write, fs::perm_options::add);
    for (const Words& words : {kFly, kCheck}) {
      expect_refused("earshotd", words, "vehicle.toml: whom the vehicle trusts can be changed by others than root");
      EXPECT_TRUE(support::has_line(said(), {name, "written", "group", "it"})) << said();
    }
    fs::permissions(folder_ / name, fs::perms::group_write, fs::perm_options::remove);
  }
  EXPECT_EQ(run("earshotd", kCheck), 0) << said();
  fs::permissions(folder_ / "vehicle.toml", fs::perms::group_write, fs::perm_options::add);
  EXPECT_EQ(start("earshot-fly", kSimulate).wait(60s), 0) << "no vehicle moves: " << said();
}

TEST_F(SignedMissions, AreVerifiedBeforeADive) {
  host::begin_counter(folder_ / "mission.counter", 4);
  ASSERT_EQ(sign(5), 0);
  EXPECT_EQ(verify(), 0) << said();
  EXPECT_TRUE(support::lines_tell(printed(), {{"mission", "mission.toml"},
                                              {"signed", "ops.pub"},
                                              {"counter", "5"},
                                              {"last", "4"},
                                              {"policy", "walk.policy"},
                                              {"signed", "walk.pub"}}));
  EXPECT_EQ(run("earshot-verify", {"--vehicle", "vehicle.toml", "walk.policy"}), 0);
  EXPECT_TRUE(support::lines_tell(printed(), {{"policy", "walk.policy"}, {"signed", "walk.pub"}}));
  EXPECT_EQ(run("earshotd", {"--vehicle", "vehicle.toml", "--check", "mission.toml", "--out", "."}), 0) << said();
  EXPECT_NE(printed().find("  signed by   ops.pub, counter 5\n"), std::string::npos) << printed();
  EXPECT_NE(printed().find("  signed by   walk.pub\n"), std::string::npos) << printed();
  ASSERT_EQ(sign(4), 0);
  EXPECT_EQ(verify(), 2);
  EXPECT_EQ(flown_last(), 4U) << "nothing has flown";
  expect_refused("earshot-verify", {"--vehicle", "vehicle.toml", EARSHOT_SOURCE_DIR "/policy/frozen/shipped.policy"},
                 "is signed by none of trust.policy_keys of vehicle.toml (walk.pub)");
}

TEST_F(SignedMissions, AreNotReadyToDiveWhereTheirCounterCannotBeWritten) {
  host::begin_counter(folder_ / "mission.counter", 0);
  ASSERT_EQ(sign(1), 0);
  const support::TemporaryFolder journals;
  fs::permissions(folder_.path(), fs::perms::owner_write, fs::perm_options::remove);
  const support::ForNoRoot earshotd(fs::path(EARSHOT_BIN_DIR) / "earshotd",
                                    {"--vehicle", "vehicle.toml", "--check", "mission.toml", "--out", journals.path()});
  expect_refused(earshotd.program, earshotd.arguments, "mission.counter: cannot be written: Permission denied");
  fs::permissions(folder_.path(), fs::perms::owner_write, fs::perm_options::add);
  EXPECT_EQ(run(earshotd.program, earshotd.arguments), 0) << said();
}

TEST_F(SignedMissions, AreNotWhatATablesOrPolicyFileIsTakenForThatDoesNotBeginAsOne) {
  std::ofstream(folder_ / "big.tables") << "x";
  fs::resize_file(folder_ / "big.tables", 5'000'000);
  expect_refused("earshot-verify", {"--vehicle", "vehicle.toml", "big.tables"}, "a .tables file has at most ");
  std::ofstream(folder_ / "text.policy") << std::string(1'000, 'x');
  expect_refused("earshot-verify", {"--vehicle", "vehicle.toml", "text.policy"}, "text.policy: is not a .policy file");
}

TEST_F(SignedMissions, AreVerifiedAsFarAsItGoesWhereTheCounterIsNot) {
  ASSERT_EQ(sign(5), 0);
  EXPECT_EQ(verify(), 1);
  EXPECT_TRUE(support::lines_tell(said(), {{"verify", "mission.counter", "no", "file", "later", "not"}}));
  expect_refused("earshotd", kFly, "mission.counter: no such file");
}

TEST_F(SignedMissions, AreSignedAgainInPlaceAndNothingElseIsReplaced) {
  ASSERT_EQ(sign(1), 0);
  ASSERT_EQ(sign(2), 0);
  EXPECT_NE(mission_.content("mission.toml.sig").find("counter 2\n"), std::string::npos);
  EXPECT_EQ(said(), "");
  ASSERT_EQ(sign(1), 0);
  EXPECT_TRUE(support::lines_tell(said(), {{"sign", "warning", "mission.toml.sig", "counter 2", "1"}}));
  EXPECT_NE(mission_.content("mission.toml.sig").find("counter 1\n"), std::string::npos);
  std::ofstream(folder_ / "mission.toml.sig") << "notes of mine\n";
  EXPECT_EQ(sign(3), 2);
  EXPECT_EQ(mission_.content("mission.toml.sig"), "notes of mine\n");
}

TEST_F(SignedMissions, AreNotSignedWhereTheyCouldNotBeFlown) {
  const Words words{"--key", "ops.key", "--counter", "1", "mission.toml"};
  const std::string good = mission_.content("mission.toml");
  std::string wrong = good;
  wrong.replace(wrong.find("step_length_m = 1000.0"), 22, "step_length_m = 1001.0");
  mission_.write(wrong);
  expect_refused("earshot-sign", words, "search.step_length_m = 1001: must be 1000");
  mission_.write(good);
  expect_refused("earshot-sign", {"--key", "ops.key", "--counter", "1", "walk.policy"},
                 "policies and ocean tables carry their signature within them");
  expect_refused("earshot-sign", {"--key", "ops.key", "--counter", "0", "mission.toml"}, "--counter");
  fs::permissions(folder_ / "ops.key", fs::perms::group_read, fs::perm_options::add);
  expect_refused("earshot-sign", words, "chmod 600 ops.key");
  fs::permissions(folder_ / "ops.key", fs::perms::group_read, fs::perm_options::remove);
  std::ofstream(folder_ / "ops.pub") << mission_.content("walk.pub");
  expect_refused("earshot-sign", words, "ops.pub: is not the public half of ops.key");
  EXPECT_FALSE(fs::exists(folder_ / "mission.toml.sig"));
}

TEST_F(SignedMissions, AreSignedWithAPairThatIsMadeOnce) {
  ASSERT_EQ(run("earshot-key", {"new.key"}), 0) << said();
  EXPECT_TRUE(support::lines_tell(printed(), {{"new.key", "secret", "new.pub"}}));
  const std::string key = mission_.content("new.key");
  expect_refused("earshot-key", {"new.key"}, "new.key: exists already");
  EXPECT_EQ(mission_.content("new.key"), key);
  EXPECT_EQ(run("earshot-sign", {"--key", "new.key", "--counter", "1", "mission.toml"}), 0) << said();
  expect_refused("earshotd", kFly, "which is none of trust.mission_keys of vehicle.toml (ops.pub)");
}

TEST_F(SignedMissions, AreMissedInOneLineWhereAMissionNamesTheKeyThatJudgesIt) {
  const std::string mission = EARSHOT_SOURCE_DIR "/firmware/boards/linux/missions/search.toml";
  EXPECT_EQ(run("earshotd", {"--check", mission, "--out", "."}), 0);
  const std::string before = said().substr(0, said().find('\n'));
  EXPECT_TRUE(before.starts_with("earshotd: warning: without --vehicle any mission is flown, whoever wrote it")) << said();
}

}  // namespace
}  // namespace earshot
