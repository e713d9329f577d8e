#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/mission/ports/port_override.hpp"
#include "tests/firmware/host/mission/shipped_mission.hpp"
#include "tests/support/secret_file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

// The last value that is allowed and the first that is not.
TEST(MissionFile, KeepsTheBoundsOfItsNumbers) {
  struct Bound {
    std::string line;
    std::string allowed;
    std::string refused;
  };
  for (const auto& [line, allowed, refused] :
       {Bound{"speed_mps = 2.0", "speed_mps = 20.0", "speed_mps = 20.1"}, Bound{"speed_mps = 2.0", "speed_mps = 0.01", "speed_mps = 0.009"},
        Bound{"speed_mps = 2.0", "speed_mps = 0.01", "speed_mps = 1e-320"},
        Bound{"step_length_m = 1000.0", "step_length_m = 1.0", "step_length_m = 0.9"},
        Bound{"latitude_deg = 38.5", "latitude_deg = 80.0", "latitude_deg = 80.1"},
        Bound{"latitude_deg = 38.5", "latitude_deg = -80.0", "latitude_deg = -80.1"},
        Bound{"longitude_deg = -28.0", "longitude_deg = 180.0", "longitude_deg = 180.1"},
        Bound{"longitude_deg = -28.0", "longitude_deg = -180.0", "longitude_deg = -180.1"},
        Bound{"max_depth_m = 400.0", "max_depth_m = 11000.0", "max_depth_m = 11000.1"},
        Bound{"max_time_s = 60000.0", "max_time_s = 10000000.0", "max_time_s = 10000001.0"},
        Bound{"navigation_timeout_s = 5.0", "navigation_timeout_s = 3600.0", "navigation_timeout_s = 3600.1"},
        Bound{"snr_timeout_s = 5.0", "snr_timeout_s = 3600.0", "snr_timeout_s = 3600.1"},
        Bound{"detection_threshold_db = 10.0", "detection_threshold_db = 200.0", "detection_threshold_db = 200.1"},
        Bound{"max_steps = 100", "max_steps = 1000000", "max_steps = 1000001"},
        Bound{"edge_margin_m = 250.0", "edge_margin_m = 0.0", "edge_margin_m = -0.1"}}) {
    EXPECT_EQ(complaint(line, allowed), "") << allowed;
    EXPECT_NE(complaint(line, refused).find("must be"), std::string::npos) << refused;
  }
}

TEST(MissionFile, ComplainsOfRoomToSearchOnlyWhereThereIsAnArea) {
  EXPECT_EQ(complaint("east_m = 25000.0", "east_m = 0.0").find("edge_margin_m"), std::string::npos);
  EXPECT_EQ(complaint("max_depth_m = 400.0", "max_depth_m = 100.0").find("edge_margin_m"), std::string::npos);
}

TEST(MissionFile, RefusesAnAreaWithoutWidthOrHeight) {
  EXPECT_TRUE(support::has_line(complaint("east_m = 25000.0", "east_m = 0.0"), {"area.east_m", "0.0", "greater than west_m"}));
  EXPECT_TRUE(support::has_line(complaint("north_m = 25000.0", "north_m = 0.0"), {"area.north_m", "0.0", "greater than south_m"}));
}

TEST(MissionFile, NamesTheKeyAndTheAutopilotThatItWaitsFor) {
  EXPECT_FALSE(load_mission(kShipped).mission.authority.needs_verified_commands);
  EXPECT_EQ(load_mission(kShipped).mission.authority.autopilot_timeout, Duration{});
  const support::TemporaryFolder folder;
  support::write_secret_file(folder / "vehicle.key", std::string(64, '7') + "\n");
  std::ofstream(folder / "mission.toml") << text_of(kShipped) << "\n[authority]\nkey_file = \"vehicle.key\"\nautopilot_timeout_s = 2.5\n";
  MissionFile file = load_mission(folder / "mission.toml");
  EXPECT_TRUE(file.mission.authority.needs_verified_commands);
  EXPECT_EQ(file.mission.authority.autopilot_timeout.us, 2'500'000);
  ASSERT_EQ(file.ports.size(), 1U);
  EXPECT_TRUE(file.ports[0].command_proof);
  override_ports(file, {.bus = "mixed", .lcm_url = {}, .can_interface = {}});
  ASSERT_EQ(file.ports.size(), 2U);
  EXPECT_FALSE(file.ports[0].command_proof) << "navigation brings no orders";
  EXPECT_TRUE(file.ports[1].command_proof);
}

TEST(MissionFile, NamesTheVehicleThatOrdersAreMarkedForAndDrawsANonceForEachStart) {
  const support::TemporaryFolder folder;
  support::write_secret_file(folder / "vehicle.key", std::string(64, '7') + "\n");
  std::ofstream(folder / "mission.toml") << text_of(kShipped)
                                         << "\n[authority]\nkey_file = \"vehicle.key\"\nvehicle_id = \"auv-7\"\naccept_old_marks = true\n";
  const MissionFile file = load_mission(folder / "mission.toml");
  ASSERT_TRUE(file.ports[0].command_proof);
  EXPECT_EQ(file.ports[0].command_proof->challenge, file.challenge);
  EXPECT_TRUE(file.ports[0].command_proof->accepts_old_marks);
  EXPECT_EQ(file.challenge.vehicle, new_challenge("auv-7", {}).vehicle);
  EXPECT_EQ(file.challenge.mission, sha256_of(std::string_view(text_of(folder / "mission.toml"))));
  EXPECT_NE(load_mission(folder / "mission.toml").challenge.nonce, file.challenge.nonce);
  EXPECT_FALSE(load_mission(kShipped).accepts_old_marks);
}

TEST(MissionFile, RefusesAVehiclesNameThatIsNone) {
  for (const std::string& name : {std::string("a b"), std::string(33, 'x'), std::string("\u00e4")})
    EXPECT_TRUE(support::has_line(complaint("[origin]", "[authority]\nvehicle_id = \"" + name + "\"\n[origin]"),
                                  {"authority.vehicle_id", name, "1 to 32 letters"}))
        << complaint("[origin]", "[authority]\nvehicle_id = \"" + name + "\"\n[origin]");
  EXPECT_EQ(complaint("[origin]", "[authority]\nvehicle_id = \"" + std::string(32, 'x') + "\"\n[origin]"), "");
}

TEST(MissionFile, RefusesAKeyThatIsNone) {
  EXPECT_NE(complaint("[origin]", "[authority]\nkey_file = \"nowhere.key\"\n[origin]").find("authority.key_file"), std::string::npos);
  EXPECT_NE(complaint("[origin]", "[authority]\nautopilot_timeout_s = 0.1\n[origin]").find("authority.autopilot_timeout_s"),
            std::string::npos);
}

}  // namespace
}  // namespace earshot::host
