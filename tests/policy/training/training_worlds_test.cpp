#include "policy/training/training_worlds.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::training {
namespace {

namespace fs = std::filesystem;
const std::string kSource = EARSHOT_SOURCE_DIR;
const std::string kMunk = kSource + "/sim/ocean/environments/munk_flat.toml";
constexpr Listening kAsTheRun{.vehicle_depth = Meters{300.0}, .frequency = Hertz{20.0}};

class TrainingWorldsTest : public testing::Test {
 protected:
  /// A world in the paper's ocean, of that seed.
  fs::path write(const std::string& name, const std::string& more = "", int seed = 1'000'000, const std::string& environment = kMunk) {
    std::ofstream(folder / name) << "name = \"a\"\nwhat = \"b\"\nseed = " << seed << "\nenvironment = \"" << environment << "\"\n" << more;
    return folder / name;
  }
  /// An environment file: the paper's with a part of it replaced.
  std::string ocean_with(const std::string& part, const std::string& by) {
    std::string text = support::read_text(kMunk);
    text.replace(text.find(part), part.size(), by);
    std::ofstream(folder / "ocean.toml") << text;
    return (folder / "ocean.toml").string();
  }
  static std::string complaint(const auto& action) {
    try {
      action();
    } catch (const host::BadInput& bad) {
      return bad.what();
    }
    return "";
  }
  static std::string complaint_about(const fs::path& world) {
    return complaint([&] { check_trainable(evaluate::load_world(world), world, kAsTheRun); });
  }
  TrainingWorlds load(const std::vector<fs::path>& named) {
    return load_worlds(named, settings, kAsTheRun, 2, [this](double share) { done.push_back(share); });
  }

  const support::TemporaryFolder folder;
  search::SearchSettings settings;
  std::vector<double> done;
};

TEST_F(TrainingWorldsTest, AreTheFilesThatAreNamedAndThoseOfFoldersByName) {
  fs::create_directories(folder / "train/oceans");
  const std::vector<fs::path> files{write("single.toml"), write("train/1.toml"), write("train/2.toml")};
  static_cast<void>(write("train/oceans/ocean.toml"));
  EXPECT_EQ(world_files(std::vector<fs::path>{folder / "single.toml", folder / "train"}), files);
}

TEST_F(TrainingWorldsTest, AreRefusedWhereOneIsNamedTwiceOrAFolderHasNone) {
  fs::create_directories(folder / "train");
  fs::create_directories(folder / "empty");
  const fs::path world = write("train/1.toml");
  EXPECT_TRUE(support::tells(complaint([&] {
                               static_cast<void>(world_files(std::vector<fs::path>{folder / "train", world}));
                             }),
                             {"--world", "worlds", world.string(), "named", "twice", "drawn", "twice", "often"}));
  EXPECT_EQ(complaint([&] { static_cast<void>(world_files(std::vector<fs::path>{folder / "empty"})); }),
            (folder / "empty").string() + ": no worlds (*.toml) there");
}

TEST_F(TrainingWorldsTest, HearWhatTheirOceanHasAtTheirOwnDepthUnderTheirOwnConditions) {
  const fs::path calm = write("calm.toml");
  const fs::path deeper = write("deeper.toml", "vehicle_depth_m = 320.0\n[conditions]\nfluctuation_db = 3.0\n");
  settings.max_steps = 7;
  const TrainingWorlds loaded = load({calm, deeper});
  ASSERT_EQ(loaded.worlds.size(), 2U);
  const Meters range{5'000.0};
  const ocean::Environment munk = ocean::load_environment(kMunk);
  const auto snr_at = [&](Meters depth) { return sonar::compute_snr_curve(munk, depth, search::furthest_range(settings)).at(range); };
  EXPECT_TRUE(loaded.worlds[0].is_calm());
  EXPECT_EQ(loaded.worlds[0].expected().at(range), snr_at(Meters{300.0}));
  EXPECT_EQ(loaded.worlds[1].conditions.fluctuation, Decibels{3.0});
  EXPECT_EQ(loaded.worlds[1].expected().at(range), snr_at(Meters{320.0}));
  EXPECT_NE(snr_at(Meters{300.0}), snr_at(Meters{320.0})) << "a depth tells nothing here";
  for (const search::World& world : loaded.worlds) EXPECT_EQ(world.settings.max_steps, 7U);
  EXPECT_EQ(done, (std::vector<double>{0.5, 1.0}));
}

TEST_F(TrainingWorldsTest, HaveAnotherChecksumWhereAWorldOrItsOceanIsAnother) {
  const std::string ocean = ocean_with("level_db_re_1upa_at_1m = 190.0", "level_db_re_1upa_at_1m = 190.0");
  const std::vector<fs::path> worlds{write("a.toml", "", 1'000'000, ocean)};
  const std::uint32_t before = load(worlds).crc32;
  EXPECT_EQ(load(worlds).crc32, before);
  static_cast<void>(write("a.toml", "", 1'000'001, ocean));
  const std::uint32_t of_another_seed = load(worlds).crc32;
  EXPECT_NE(of_another_seed, before);
  static_cast<void>(ocean_with("level_db_re_1upa_at_1m = 190.0", "level_db_re_1upa_at_1m = 191.0"));
  EXPECT_NE(load(worlds).crc32, of_another_seed);
}

TEST_F(TrainingWorldsTest, AreNoneThatPoliciesAreJudgedIn) {
  for (const fs::path world : {kSource + "/policy/worlds/paper.toml", kSource + "/policy/worlds/../worlds/test/test_043.toml",
                               write("drawn.toml", "", 2'000'000).string(), write("last.toml", "", 3'999'999).string()}) {
    EXPECT_TRUE(support::tells(complaint_about(world), {world.string(), "in", "none", "policy/worlds/generate"}));
  }
  EXPECT_EQ(complaint_about(write("drawn.toml", "", 1'999'999)), "");
  EXPECT_EQ(complaint_about(write("drawn.toml", "", 4'000'000)), "");
}

/// A tenth of the depth, a twentieth of the frequency: kDepthTolerance, kFrequencyTolerance.
TEST_F(TrainingWorldsTest, AreRefusedAtAnotherDepthOrFrequencyThanThePolicyIsTrainedFor) {
  EXPECT_EQ(complaint_about(write("a.toml", "vehicle_depth_m = 330.0\n")), "");
  const fs::path deep = write("a.toml", "vehicle_depth_m = 331.0\n");
  EXPECT_TRUE(support::tells(complaint_about(deep), {deep.string(), "vehicle_depth_m", "331", "300", "within 10 %"}));
  EXPECT_EQ(complaint_about(write("a.toml", "", 1, ocean_with("frequency_hz = 20.0", "frequency_hz = 21.0"))), "");
  const fs::path high = write("a.toml", "", 1, ocean_with("frequency_hz = 20.0", "frequency_hz = 21.1"));
  EXPECT_TRUE(support::tells(complaint_about(high), {high.string(), "source.frequency_hz", "environment", "21.1", "20", "within 5 %"}));
}

TEST_F(TrainingWorldsTest, AreRefusedWhereTheTrainingsDepthIsBelowTheSeaFloor) {
  const fs::path shallow = write("a.toml", "", 1, ocean_with("depth_m = 3000.0", "depth_m = 250.0"));
  EXPECT_TRUE(support::tells(complaint_about(shallow), {"--vehicle-depth-m", "300", "less than 250 m", shallow.string()}));
}

TEST_F(TrainingWorldsTest, AreTheSameUnderAnotherNameToo) {
  for (const char* name : {"policy", "sim"}) fs::create_directory_symlink(kSource + "/" + name, folder / name);
  EXPECT_NE(complaint_about(folder / "policy/worlds/paper.toml").find("is a world that policies are judged in"), std::string::npos);
  fs::create_directories(folder / "train");
  const fs::path world = write("train/1.toml");
  fs::create_symlink(world, folder / "alias.toml");
  for (const fs::path& other : std::vector<fs::path>{folder / "train/../train/1.toml", folder / "alias.toml"}) {
    EXPECT_TRUE(support::tells(complaint([&] {
                                 static_cast<void>(world_files(std::vector<fs::path>{world, other}));
                               }),
                               {"--world", "worlds", other.string(), "named", "twice", "drawn", "twice", "often"}));
  }
}

}  // namespace
}  // namespace earshot::training
