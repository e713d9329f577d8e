#include "firmware/host/trust/vehicle_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

class VehicleConfiguration : public testing::Test {
 protected:
  VehicleConfiguration() {
    for (const char name : {'a', 'b', 'c'}) std::ofstream(folder_ / (std::string(1, name) + ".pub")) << std::string(64, name) << "\n";
  }
  VehicleFile load(const std::string& trust) {
    std::ofstream(file_) << "[trust]\n" << trust;
    return load_vehicle(file_);
  }
  std::string complaint(const std::string& trust) {
    return complaint_of([&] { (void)load(trust); });
  }

  const support::TemporaryFolder folder_;
  const fs::path file_ = folder_ / "vehicle.toml";
};

TEST_F(VehicleConfiguration, NamesKeysCounterAndCommandKeyFromItsOwnFolder) {
  const VehicleFile vehicle = load(
      "policy_keys = [\"a.pub\"]\nmission_keys = [\"b.pub\", \"c.pub\"]\ncounter_file = \"mission.counter\"\n"
      "command_key_file = \"/secret/command.key\"\n");
  EXPECT_EQ(files_of(vehicle.policy_keys), (folder_ / "a.pub").string());
  ASSERT_EQ(vehicle.mission_keys.size(), 2U);
  EXPECT_EQ(to_hex(vehicle.mission_keys[1].key), std::string(64, 'c'));
  EXPECT_TRUE(vehicle.requires_signed_mission) << "where nothing is said";
  EXPECT_EQ(vehicle.counter_file, folder_ / "mission.counter");
  EXPECT_EQ(vehicle.command_key_file, "/secret/command.key");
}

TEST_F(VehicleConfiguration, NamesTheVehicleAndWhetherOldMarksCount) {
  const std::string keys = "policy_keys = [\"a.pub\"]\nrequire_signed_mission = false\n";
  EXPECT_EQ(load(keys).vehicle_id, "");
  EXPECT_FALSE(load(keys).accepts_old_marks);
  EXPECT_EQ(load(keys + "vehicle_id = \"auv-7_b.2\"\n").vehicle_id, "auv-7_b.2");
  EXPECT_TRUE(load(keys + "accept_old_marks = true\n").accepts_old_marks);
  for (const std::string& name : {std::string("auv 7"), std::string(33, 'x'), std::string("auv/7")})
    EXPECT_NE(complaint(keys + "vehicle_id = \"" + name + "\"\n").find("trust.vehicle_id = '" + name + "': must be 1 to 32 letters"),
              std::string::npos);
}

TEST_F(VehicleConfiguration, NeedsNoMissionKeysWhereMissionsNeedNoSignature) {
  const VehicleFile vehicle = load("policy_keys = [\"a.pub\"]\nrequire_signed_mission = false\n");
  EXPECT_FALSE(vehicle.requires_signed_mission);
  EXPECT_FALSE(vehicle.command_key_file);
}

TEST_F(VehicleConfiguration, IsRefusedWithEverythingThatIsWrong) {
  const std::string said = complaint("policy_keys = [\"a.pub\", \"none.pub\", \"a.pub\"]\nmission_keys = []\nmission_key = \"b.pub\"\n");
  for (const std::string part :
       {":2: trust.policy_keys: ", "none.pub: no such file", "\"a.pub\" is a key that stands there already",
        ":3: trust.mission_keys: must name at least one", ":4: trust.mission_key: unknown key", "trust.counter_file is missing"})
    EXPECT_NE(said.find(part), std::string::npos) << part << " is not in: " << said;
  EXPECT_NE(complaint("policy_keys = \"a.pub\"\nmission_keys = [7]\ncounter_file = \"c\"\n").find("must be an array of texts"),
            std::string::npos);
}

TEST_F(VehicleConfiguration, WithoutItsTableIsRefused) {
  std::ofstream(file_) << "";
  EXPECT_NE(complaint_of([this] { (void)load_vehicle(file_); }).find("trust is missing"), std::string::npos);
}

TEST_F(VehicleConfiguration, IsTheNamedOneElseTheUsualOneIfAnythingIsThere) {
  const fs::path usual = folder_ / "usual.toml";
  EXPECT_EQ(vehicle_file_of(std::nullopt, usual), std::nullopt);
  EXPECT_EQ(vehicle_file_of(file_, usual), file_);
  fs::create_symlink("nowhere", usual);
  EXPECT_EQ(vehicle_file_of(std::nullopt, usual), usual) << "a link that leads nowhere is refused when it is read, and not passed over";
}

}  // namespace
}  // namespace earshot::host
