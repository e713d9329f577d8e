#include "firmware/host/mission/mission_verifier.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/layer_weights.hpp"
#include "tests/support/process.hpp"
#include "tests/support/signed_mission.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"
#include "tests/support/three_oceans.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

const std::string kShipped = EARSHOT_SOURCE_DIR "/firmware/boards/linux/missions/search.toml";

class MissionVerified : public testing::Test {
 protected:
  MissionVerified() {
    mission_.write(text_);
    mission_.sign(7);
    begin_counter(folder_ / "mission.counter", 0);
  }

  /// Judges all of it, and flies it if it may.
  void fly(Counting counting = Counting::kRecorded) {
    MissionVerifier judge(load_vehicle(folder_ / "vehicle.toml"), counting);
    file_ = judge.load_mission(folder_ / "mission.toml");
    (void)judge.load_search(file_);
    judge.record_flight();
  }
  std::string complaint() {
    return complaint_of([this] { fly(); });
  }
  void expect_refused(const std::string& why) {
    const std::string counter = mission_.content("mission.counter");
    const std::string said = complaint();
    EXPECT_NE(said.find(why), std::string::npos) << why << " is not in: " << said;
    EXPECT_EQ(mission_.content("mission.counter"), counter) << "what is refused leaves the counter";
  }

  const support::TemporaryFolder folder_;
  const support::SignedMission mission_{folder_};
  const std::string text_ = support::mission_of_the_walk(support::read_text(kShipped));
  MissionFile file_;
};

TEST_F(MissionVerified, FliesWhenItIsSignedByWhoIsTrusted) {
  ASSERT_EQ(complaint(), "");
  EXPECT_EQ(read_flown_last(folder_ / "mission.counter").counter, 7U);
  EXPECT_EQ(file_.policy, folder_ / "walk.policy");
  EXPECT_FALSE(file_.mission.authority.needs_verified_commands);
}

TEST_F(MissionVerified, IsRefusedWithoutASignature) {
  fs::remove(folder_ / "mission.toml.sig");
  expect_refused("mission.toml: is not signed, which trust.require_signed_mission of");
}

TEST_F(MissionVerified, IsRefusedWhenAnyByteOfItHasChanged) {
  mission_.write(text_ + " ");
  expect_refused("mission.toml: has been changed since");
}

TEST_F(MissionVerified, IsNotReadAsTomlBeforeItsSignatureHolds) {
  mission_.write("[[[[[");
  expect_refused("has been changed since");
}

TEST_F(MissionVerified, IsRefusedWhenAStrangerSignedIt) {
  SecretKey stranger;
  stranger.seed.fill(9);
  mission_.sign(7, stranger);
  expect_refused("is of the key " + to_hex(public_key_of(stranger)) + ", which is none of trust.mission_keys of");
}

// The key that signs policies must not be able to send a vehicle to sea.
TEST_F(MissionVerified, IsRefusedWhenWhoMaySignPoliciesSignedIt) {
  SecretKey policys;
  policys.seed.fill(7);
  ASSERT_EQ(public_key_of(policys), support::public_key());
  mission_.sign(7, policys);
  expect_refused("which is none of trust.mission_keys of");
}

TEST_F(MissionVerified, IsRefusedWhenItsSignatureIsForged) {
  std::string text = mission_.content("mission.toml.sig");
  text.replace(text.find("counter 7"), 9, "counter 8");
  std::ofstream(folder_ / "mission.toml.sig") << text;
  expect_refused("mission.toml.sig: is forged or damaged: the holder of");
}

TEST_F(MissionVerified, IsRefusedWithAnotherPolicyThoughThatIsTrusted) {
  policy::FrozenPolicy other = support::random_walk_policy();
  other.draw = policy::ActionDraw::kArgmax;
  support::write_bytes(folder_ / "walk.policy", support::signed_bytes(other));
  expect_refused("walk.policy: with its ocean tables is not the policy that");
}

TEST_F(MissionVerified, IsRefusedWithAPolicyOfAStrangerThoughTheMissionVouchesForIt) {
  fs::copy_file(EARSHOT_SOURCE_DIR "/policy/frozen/shipped.policy", folder_ / "walk.policy", fs::copy_options::overwrite_existing);
  mission_.sign(7);
  expect_refused("walk.policy: is signed by none of trust.policy_keys of");
}

TEST_F(MissionVerified, IsRefusedWhenALaterOneHasFlown) {
  mission_.sign(8);
  ASSERT_EQ(complaint(), "");
  mission_.sign(7);
  expect_refused("counter 7 is rolled back: the vehicle has flown 8");
}

TEST_F(MissionVerified, FliesAgainWithItsCounterOnlyAsTheSameBytes) {
  ASSERT_EQ(complaint(), "");
  EXPECT_EQ(complaint(), "") << "after a restart";
  mission_.write(text_ + "# another\n");
  mission_.sign(7);
  expect_refused("counter 7 has been used, and not for this mission and policy");
}

TEST_F(MissionVerified, IsRefusedWhenItsCounterWouldLeaveNoneForLaterMissions) {
  mission_.sign(9'223'372'036'854'775'807U);
  const std::string said = complaint();
  EXPECT_TRUE(support::has_line(said, {"counter 9223372036854775807", "4294967296", "above 0"})) << said;
  EXPECT_TRUE(said.ends_with("): a slip? Sign with a lower counter")) << said << " (no --raise-counter goes so far)";
  mission_.sign(4'611'686'018'427'387'906U);
  EXPECT_TRUE(complaint().ends_with(": a slip? Sign with a lower counter")) << complaint();
  mission_.sign(4'611'686'018'427'387'905U);
  EXPECT_TRUE(complaint().ends_with("--raise-counter 4611686018427387904")) << complaint();
  mission_.sign(4'294'967'298U);
  expect_refused("earshot verify --vehicle " + (folder_ / "vehicle.toml").string() + " --raise-counter 4294967297");
  raise_counter(folder_ / "mission.counter", 4'294'967'297U);
  EXPECT_EQ(complaint(), "");
}

TEST_F(MissionVerified, IsRefusedWithoutTheCounterOfWhatFlewLast) {
  fs::remove(folder_ / "mission.counter");
  EXPECT_NE(complaint().find("mission.counter: no such file"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "mission.counter"));
}

TEST_F(MissionVerified, LeavesTheCounterInASimulationAndInAChecklist) {
  fly(Counting::kOnlyRead);
  fly(Counting::kVerified);
  fly(Counting::kLeftOut);
  EXPECT_EQ(read_flown_last(folder_ / "mission.counter").counter, 0U);
}

TEST_F(MissionVerified, TakesTheKeyOfItsCommandsFromTheVehicleAlone) {
  support::write_secret_file(folder_ / "mission.key", std::string(64, '1'));
  support::write_secret_file(folder_ / "vehicle.key", std::string(64, '2'));
  mission_.write(text_ + "\n[authority]\nkey_file = \"mission.key\"\n");
  mission_.sign(7);
  expect_refused("authority.key_file = 'mission.key': no signature covers that key");
  mission_.write_vehicle("command_key_file = \"vehicle.key\"\n");
  ASSERT_EQ(complaint(), "");
  EXPECT_TRUE(file_.mission.authority.needs_verified_commands);
  KeyBytes vehicles;
  vehicles.fill(0x22);
  messages::OperatorCommand command;
  ASSERT_TRUE(file_.command_key);
  command.mark = CommandKey(vehicles).mark_of(command, file_.challenge);
  EXPECT_TRUE(file_.command_key->verifies(command, file_.challenge));
}

TEST_F(MissionVerified, ObeysTheVehiclesCommandKeyAlsoWhereItNamesNone) {
  support::write_secret_file(folder_ / "vehicle.key", std::string(64, '2'));
  mission_.write_vehicle("command_key_file = \"vehicle.key\"\n");
  ASSERT_EQ(complaint(), "");
  EXPECT_TRUE(file_.mission.authority.needs_verified_commands);
  for (const PortSettings& port : file_.ports) EXPECT_EQ(port.command_proof.has_value(), port.roles.has(Role::kOperator)) << port.name;
}

TEST_F(MissionVerified, IsFlownByTheVehicleThatItIsForAlone) {
  mission_.write_vehicle("vehicle_id = \"auv-7\"\n");
  ASSERT_EQ(complaint(), "");
  EXPECT_EQ(std::string(file_.challenge.vehicle.begin(), file_.challenge.vehicle.begin() + 6), std::string("auv-7\0", 6));
  EXPECT_EQ(file_.challenge.mission, sha256_of(std::string_view(mission_.content("mission.toml"))));
  mission_.write(text_ + "\n[authority]\nvehicle_id = \"auv-8\"\n");
  mission_.sign(8);
  expect_refused("authority.vehicle_id = 'auv-8': is another vehicle: this one is \"auv-7\" (trust.vehicle_id in");
  mission_.write(text_ + "\n[authority]\nvehicle_id = \"auv-7\"\n");
  mission_.sign(8);
  EXPECT_EQ(complaint(), "");
}

TEST_F(MissionVerified, DoesNotMakeOldMarksCountWithTheVehiclesKey) {
  support::write_secret_file(folder_ / "vehicle.key", std::string(64, '2'));
  mission_.write_vehicle("command_key_file = \"vehicle.key\"\n");
  mission_.write(text_ + "\n[authority]\naccept_old_marks = true\n");
  mission_.sign(7);
  expect_refused("authority.accept_old_marks = true: is the vehicle's to give, whose key it is: trust.accept_old_marks in");
  mission_.write(text_);
  mission_.sign(7);
  ASSERT_EQ(complaint(), "");
  EXPECT_FALSE(file_.accepts_old_marks);
  mission_.write_vehicle("command_key_file = \"vehicle.key\"\naccept_old_marks = true\n");
  ASSERT_EQ(complaint(), "");
  EXPECT_TRUE(file_.accepts_old_marks);
}

TEST_F(MissionVerified, NeedsNoSignatureWhereTheVehicleAsksForNone) {
  mission_.write_vehicle("require_signed_mission = false\n");
  fs::remove(folder_ / "mission.toml.sig");
  fs::remove(folder_ / "mission.counter");
  EXPECT_EQ(complaint(), "");
  fs::copy_file(EARSHOT_SOURCE_DIR "/policy/frozen/shipped.policy", folder_ / "walk.policy", fs::copy_options::overwrite_existing);
  EXPECT_TRUE(support::has_line(complaint(), {"signed", "none", "trust.policy_keys"}));
}

/// A mission whose policy searches by ocean tables, all signed by who is trusted.
class MissionVerifiedWithTables : public MissionVerified {
 protected:
  MissionVerifiedWithTables() {
    policy_ = support::signed_bytes(believing());
    support::write_bytes(folder_ / "walk.policy", policy_);
    mission_.write(in_folder_of_tables());
    write_tables(Meters{300.0});
    sign_all();
  }

  [[nodiscard]] std::string in_folder_of_tables() const {
    std::string text = text_;
    return text.replace(text.find("[policy]\n"), 9, "[policy]\ntables = \"oceans.tables\"\n");
  }
  static policy::FrozenPolicy believing() {
    policy::FrozenPolicy policy = support::random_walk_policy();
    policy.observation.belief.area_size = policy.area_size;
    policy.observation.belief.actions = policy.actions;
    policy.observation.spec = policy::belief_state(policy.observation.belief);
    tests::set_inputs(policy.network, policy.observation.spec.size());
    return policy;
  }
  void write_tables(Meters depth) {
    tables_ = support::signed_bytes(*support::three_oceans({Meters{25'000.0}, Meters{25'000.0}}, depth));
    support::write_bytes(folder_ / "oceans.tables", tables_);
  }
  void sign_all() { mission_.sign(7, digest_of(policy_, tables_)); }

  std::vector<std::uint8_t> policy_;
  std::vector<std::uint8_t> tables_;
};

TEST_F(MissionVerifiedWithTables, FliesByThem) {
  MissionVerifier judge(load_vehicle(folder_ / "vehicle.toml"), Counting::kOnlyRead);
  const SignedSearch search = judge.load_search(judge.load_mission(folder_ / "mission.toml"));
  EXPECT_EQ(search.tables_file, folder_ / "oceans.tables");
  EXPECT_EQ(search.tables.tables->tables.size(), 3U);
  EXPECT_EQ(search.tables.bytes, tables_);
  EXPECT_EQ(search.tables.signer, folder_ / "walk.pub");
}

TEST_F(MissionVerifiedWithTables, IsRefusedWhenTheyAreOfAnotherDepth) {
  write_tables(Meters{200.0});
  sign_all();
  expect_refused("is listened to at 20 Hz, 300 m deep, ");
}

TEST_F(MissionVerifiedWithTables, IsRefusedWhenTheyAreOthersThanItWasSignedWith) {
  write_tables(Meters{310.0});
  expect_refused("walk.policy: with its ocean tables is not the policy that ");
}

TEST_F(MissionVerifiedWithTables, IsRefusedWhenNobodySignedThem) {
  tables_.back() ^= 1U;
  support::write_bytes(folder_ / "oceans.tables", tables_);
  sign_all();
  expect_refused("oceans.tables: ");
}

TEST_F(MissionVerifiedWithTables, IsRefusedWhenTheyAreDamagedOrCutShort) {
  tables_[200] ^= 1U;
  support::write_bytes(folder_ / "oceans.tables", tables_);
  expect_refused("oceans.tables: is damaged: its CRC-32 is wrong");
  tables_.resize(100);
  support::write_bytes(folder_ / "oceans.tables", tables_);
  expect_refused("oceans.tables: is cut short");
}

TEST_F(MissionVerified, IsJudgedByItsOwnWordWhereThereIsNoVehicle) {
  MissionVerifier judge;
  EXPECT_NE(complaint_of([&] { (void)judge.load_mission(folder_ / "mission.toml"); }).find("policy.public_key_file is missing"),
            std::string::npos);
  EXPECT_NO_THROW((void)judge.load_search(judge.load_mission(kShipped)));
}

}  // namespace
}  // namespace earshot::host
