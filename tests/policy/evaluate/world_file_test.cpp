#include "policy/evaluate/world_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/scenario/soundscape.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::evaluate {
namespace {

namespace fs = std::filesystem;
const fs::path kPolicy = fs::path(EARSHOT_SOURCE_DIR) / "policy";
const std::string kMunk = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";

/// The validation worlds and the test split.
std::vector<fs::path> all_worlds() {
  std::vector<fs::path> all = worlds_in(kPolicy / "worlds");
  for (const fs::path& path : worlds_in(kPolicy / "worlds/test")) all.push_back(path);
  return all;
}

std::string refusal_of(const fs::path& path) {
  try {
    (void)load_world(path);
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "";
}

TEST(Worlds, AreToldFromEnvironmentsAndMissionsInOneLineAndABareNameGetsItsFile) {
  EXPECT_TRUE(support::tells(refusal_of(kMunk), {"--world", kMunk, "--environment", "not", "--world"}));
  const std::string mission = std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/search.toml";
  EXPECT_TRUE(support::tells(refusal_of(mission), {"--world", mission, "--mission", "not a world"}));
  const std::string rock = (kPolicy / "worlds/rock.toml").string();
  EXPECT_TRUE(support::tells(refusal_of("rock"), {"rock", "no", "world", "ships", rock}));
  EXPECT_TRUE(support::tells(refusal_of("rock.toml"), {"rock.toml", "no", "world", "ships", rock}));
  EXPECT_EQ(refusal_of("swordfish"), "swordfish: no such file");
}

TEST(Worlds, BearTheNamesOfTheirFilesAndEachASeedOfItsOwn) {
  std::set<std::uint64_t> seeds;
  for (const fs::path& path : all_worlds()) {
    const WorldFile world = load_world(path);
    EXPECT_EQ(world.name, path.stem().string());
    EXPECT_TRUE(seeds.insert(world.seed).second) << path << ": its seed is another's too";
    EXPECT_NE(world.seed, 1U) << path << ": training begins with seed 1";
  }
  EXPECT_EQ(seeds.size(), 33U + 40U);
}

TEST(Worlds, AreNamedByNoTrainingRun) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kPolicy)) {
    const fs::path& path = entry.path();
    const bool may_train = path.extension() == ".toml" || path.filename() == "make";
    if (!may_train || path.string().find("/worlds/") != std::string::npos) continue;
    ++files;
    std::ifstream stream(path);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    EXPECT_EQ(text.find("environment = \"../worlds"), std::string::npos) << path;
    EXPECT_EQ(text.find("worlds/oceans"), std::string::npos) << path;
    EXPECT_EQ(text.find("worlds/test"), std::string::npos) << path << " names the test split";
    for (const fs::path& world : worlds_in(kPolicy / "worlds"))
      EXPECT_EQ(text.find("worlds/" + world.filename().string()), std::string::npos) << path << " names " << world;
  }
  EXPECT_GE(files, 2) << "found no run files to look at";
}

TEST(Worlds, HillyHearsAnotherSnrInEveryDirection) {
  const WorldFile world = load_world(kPolicy / "worlds" / "hilly.toml");
  const search::Soundscape sounds = search::soundscape_of(world.scenario, Meters{300.0}, Meters{36'400.0});
  EXPECT_EQ(sounds.ocean_count(), 1U);
  EXPECT_FALSE(sounds.is_one_curve());
  const NorthEast source{Meters{12'500.0}, Meters{12'500.0}};
  const std::size_t field = sounds.field_of(0, source);
  const double north_db = sounds.snr(field, source, {Meters{20'500.0}, Meters{12'500.0}}).value;
  const double east_db = sounds.snr(field, source, {Meters{12'500.0}, Meters{20'500.0}}).value;
  EXPECT_GT(std::abs(north_db - east_db), 1.0);
  // Spherical spreading over 8 km is 78 dB, cylindrical from 2500 m on 73 dB: an SNR of about 25 dB, less what the bottom takes.
  EXPECT_TRUE(north_db > -20.0 && north_db < 40.0) << north_db;
}

TEST(Worlds, SeamountHearsLittleOfASourceBehindIt) {
  const WorldFile world = load_world(kPolicy / "worlds" / "seamount.toml");
  const search::Soundscape sounds = search::soundscape_of(world.scenario, Meters{300.0}, Meters{36'400.0});
  const NorthEast source{Meters{9'000.0}, Meters{3'000.0}};
  const std::size_t field = sounds.field_of(0, source);
  // Over 20 km beyond the summit, and as far along the foot of the mountain, in places 1 km apart so that rings of loud and faint even out.
  double behind_db = 0.0;
  double beside_db = 0.0;
  for (double km = 15.0; km <= 20.0; km += 1.0) {
    behind_db += sounds.snr(field, source, {Meters{9'000.0 + 345.0 * km}, Meters{3'000.0 + 939.0 * km}}).value / 6.0;
    beside_db += sounds.snr(field, source, {Meters{9'000.0 + 1'000.0 * km}, source.east}).value / 6.0;
  }
  EXPECT_LT(behind_db, beside_db - 3.0);
}

class LoadWorld : public testing::Test {
 protected:
  WorldFile load(const std::string& text) {
    std::ofstream(path_) << text;
    return load_world(path_);
  }
  std::string complaint(const std::string& text) {
    try {
      (void)load(text);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "";
  }
  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "world.toml";
};

TEST_F(LoadWorld, GivesItsConditionsToItsEnvironment) {
  const WorldFile world =
      load("name = \"a\"\nwhat = \"b\"\nseed = 5\nenvironment = \"" + kMunk + "\"\n[conditions]\nfluctuation_db = 3.0\n");
  EXPECT_EQ(world.seed, 5U);
  EXPECT_EQ(world.scenario.conditions.fluctuation, Decibels{3.0});
  EXPECT_EQ(world.scenario.environment.source.level, Decibels{190.0});
}

TEST_F(LoadWorld, SaysHowDeepTheVehicleIsWhereItIsTold) {
  const std::string world = "name = \"a\"\nwhat = \"b\"\nseed = 5\nenvironment = \"" + kMunk + "\"\n";
  EXPECT_EQ(load(world).vehicle_depth, std::nullopt);
  EXPECT_EQ(load(world + "vehicle_depth_m = 40.0\n").vehicle_depth, Meters{40.0});
}

TEST_F(LoadWorld, RefusesAVehicleOutsideTheWater) {
  const std::string world = "name = \"a\"\nwhat = \"b\"\nseed = 5\nenvironment = \"" + kMunk + "\"\n";
  EXPECT_EQ(load(world + "vehicle_depth_m = 2999.9\n").vehicle_depth, Meters{2'999.9});
  EXPECT_TRUE(support::has_line(complaint(world + "vehicle_depth_m = 3000.0\n"),
                                {"world.toml:5", "vehicle_depth_m", "3000", "less than", kMunk, "3000 m"}))
      << complaint(world + "vehicle_depth_m = 3000.0\n");
  EXPECT_NE(complaint(world + "vehicle_depth_m = 0.0\n").find("vehicle_depth_m"), std::string::npos);
}

TEST_F(LoadWorld, IsRefusedWithWhatIsWrong) {
  EXPECT_NE(complaint("name = \"a\"\nwhat = \"b\"\nenvironment = \"" + kMunk + "\"\n").find("seed is missing"), std::string::npos);
  EXPECT_TRUE(
      support::has_line(complaint("name = \"a\"\nwhat = \"b\"\nseed = 1\nenvironment = \"none.toml\"\n"), {"none.toml", "no", "file"}));
  EXPECT_TRUE(support::has_line(complaint("name = \"a\"\nwhat = \"b\"\nseed = 1\nenvironment = \"" + kMunk + "\"\nsead = 1\n"),
                                {"sead", "unknown"}));
}

TEST_F(LoadWorld, IsLookedForInAFolderThatHasSome) {
  EXPECT_THROW((void)worlds_in("/nowhere"), host::BadInput);
}

}  // namespace
}  // namespace earshot::evaluate
