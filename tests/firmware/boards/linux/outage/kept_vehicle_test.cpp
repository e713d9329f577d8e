#include "firmware/boards/linux/outage/kept_vehicle.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/ports/port_override.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;

host::MissionFile shipped(const std::string& name) {
  return host::load_mission(fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions" / name);
}

TEST(KeptVehicle, IsEveryShippedMissionsWithItsPortsButForHydrophones) {
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions")) {
    host::MissionFile file = host::load_mission(entry.path());
    const std::vector<std::uint8_t> bytes = kept_vehicle(file);
    const std::optional<host::MissionFile> kept = vehicle_of(bytes);
    ASSERT_TRUE(kept) << entry.path();
    host::leave_out_hydrophones(file);
    EXPECT_EQ(kept->mission, file.mission) << entry.path();
    EXPECT_EQ(kept->step_period, file.step_period);
    ASSERT_EQ(kept->ports.size(), file.ports.size());
    for (std::size_t i = 0; i < file.ports.size(); ++i) {
      EXPECT_EQ(kept->ports[i].name, file.ports[i].name);
      EXPECT_EQ(kept->ports[i].address, file.ports[i].address);
      EXPECT_EQ(kept->ports[i].kind, file.ports[i].kind);
      EXPECT_EQ(kept->ports[i].roles, file.ports[i].roles);
      EXPECT_EQ(kept->ports[i].n2k.address, file.ports[i].n2k.address);
      EXPECT_EQ(kept->ports[i].n2k.unique_number, file.ports[i].n2k.unique_number);
    }
    EXPECT_EQ(kept_vehicle(file), bytes) << "the same mission is the same bytes";
  }
}

TEST(KeptVehicle, IsNoneOfOtherBytesNorOfANameThatIsTooLong) {
  host::MissionFile file = shipped("search.toml");
  std::vector<std::uint8_t> bytes = kept_vehicle(file);
  bytes[0] ^= 1;  // of another format
  EXPECT_FALSE(vehicle_of(bytes));
  bytes[0] ^= 1;
  bytes.pop_back();
  EXPECT_FALSE(vehicle_of(bytes));
  EXPECT_FALSE(vehicle_of({}));
  file.ports[0].address = std::string(256, 'x');
  EXPECT_TRUE(kept_vehicle(file).empty());
}

}  // namespace
}  // namespace earshot::board
