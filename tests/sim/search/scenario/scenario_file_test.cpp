#include "sim/search/scenario/conditions_table.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "sim/field_library/store.hpp"
#include "sim/search/scenario/scenario_file.hpp"
#include "tests/support/bytes_read.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::search {
namespace {

namespace fs = std::filesystem;
const std::string kMunk = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";

/// One position, one depth, and more fields than are read at once for their checksum.
void write_library(const fs::path& path, float last_loss_db) {
  constexpr std::size_t kBearings = 1000;
  constexpr std::size_t kRanges = 500;
  const field_library::LibraryPlan plan{.name = "one",
                                        .environment = {},
                                        .positions = {{Meters{0.0}, Meters{0.0}}},
                                        .centre = field_library::Centre::kSource,
                                        .fan = {.bearings = kBearings,
                                                .radial = {.source_depth = Meters{30.0},
                                                           .depth_m = {100.0},
                                                           .range_step = Meters{100.0},
                                                           .ranges = kRanges,
                                                           .band = {Hertz{20.0}, Hertz{20.0}}}},
                                        .file_crc32 = 1};
  std::vector<float> loss_db(kBearings * kRanges, 60.0F);
  loss_db.back() = last_loss_db;
  fs::remove(path);
  field_library::LibraryStore store(path, plan);
  store.write(0, loss_db);
  store.commit();
}

/// The paper's ocean with more tables behind it.
class ScenarioFile : public testing::Test {
 protected:
  Scenario load(const std::string& tables, const std::string& file = "ocean.toml") {
    std::ifstream munk(kMunk);
    std::ofstream(folder_ / file) << std::string(std::istreambuf_iterator<char>(munk), {}) << tables;
    return load_scenario(folder_ / file);
  }
  std::string complaint(const std::string& tables) {
    try {
      (void)load(tables);
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "";
  }
  void expect_refused(const std::string& tables, const std::string& part) {
    const std::string text = complaint(tables);
    EXPECT_NE(text.find(part), std::string::npos) << tables << " gives: " << text;
  }

  const support::TemporaryFolder folder_;
};

TEST_F(ScenarioFile, IsCalmWhereItSaysNothing) {
  const Scenario scenario = load_scenario(kMunk);
  EXPECT_TRUE(is_calm(scenario.conditions));
  EXPECT_TRUE(scenario.other_oceans.empty());
  EXPECT_TRUE(scenario.field_library.empty());
}

TEST_F(ScenarioFile, IsCalmWhereItsConditionsSayNothing) {
  const Conditions c = load("[conditions]\n").conditions;
  EXPECT_TRUE(is_calm(c));
  EXPECT_FALSE(c.least_fluctuation.has_value());
  EXPECT_EQ(c.vehicle_speed, MetersPerSecond{2.0});
  EXPECT_EQ(c.sound.lost_blocks, 0.0);
  EXPECT_EQ(c.sound.self_noise, Decibels{65.0});
  const Conditions drifting = load("[conditions.current]\nspeed_mps = 0.1\n").conditions;
  EXPECT_FALSE(drifting.current->toward.has_value()) << "drawn for every search";
  EXPECT_EQ(drifting.current->navigation, Current::Navigation::kSeesIt);
}

TEST_F(ScenarioFile, HasEveryKeyRead) {
  const Conditions c = load(R"(
[conditions]
fluctuation_db = 4.0
least_fluctuation_db = 1.0
floor_db = 5.0
source_level_spread_db = 6.0
navigation_drift_m_per_sqrt_km = 50.0
source_speed_mps = 0.5
sources = 2
vehicle_speed_mps = 1.5
[conditions.sound]
lost_blocks = 0.02
self_noise_db_re_1upa_at_2mps = 70.0
[conditions.current]
speed_mps = 0.25
toward_deg = 90.0
seen_by_navigation = false
[conditions.calls]
interval_s = 15.0
song_s = 600.0
pause_s = 120.0
listening_s = 30.0
)")
                           .conditions;
  EXPECT_FALSE(is_calm(c));
  EXPECT_EQ(c.fluctuation, Decibels{4.0});
  EXPECT_EQ(c.least_fluctuation, Decibels{1.0});
  EXPECT_EQ(c.floor, Decibels{5.0});
  EXPECT_EQ(c.source_level_spread, Decibels{6.0});
  EXPECT_EQ(c.drift_m_per_sqrt_km, 50.0);
  EXPECT_EQ(c.source_speed, MetersPerSecond{0.5});
  EXPECT_EQ(c.sources, 2U);
  EXPECT_EQ(c.vehicle_speed, MetersPerSecond{1.5});
  EXPECT_EQ(c.sound.lost_blocks, 0.02);
  EXPECT_EQ(c.sound.self_noise, Decibels{70.0});
  EXPECT_EQ(c.current->speed, MetersPerSecond{0.25});
  EXPECT_EQ(c.current->toward, Radians{std::numbers::pi / 2.0});
  EXPECT_EQ(c.current->navigation, Current::Navigation::kDoesNotSeeIt);
  EXPECT_EQ(c.calls->interval_s, 15.0);
  EXPECT_EQ(c.calls->song_s, 600.0);
  EXPECT_EQ(c.calls->pause_s, 120.0);
  EXPECT_EQ(c.calls->listening_s, 30.0);
}

TEST_F(ScenarioFile, TakesTheLeastAndTheMostOfEachConditionAndNothingBeyond) {
  struct Limits {
    std::string table, key, below, least, most, above;
  };
  const std::string current = "[conditions.current]\nspeed_mps = 1.0\n";
  for (const Limits& limits :
       std::vector<Limits>{{"[conditions]\n", "fluctuation_db", "-0.1", "0.0", "100.0", "100.1"},
                           {"[conditions]\nfluctuation_db = 2.0\n", "least_fluctuation_db", "-0.1", "0.0", "2.0", "2.1"},
                           {"[conditions]\n", "floor_db", "-100.1", "-100.0", "100.0", "100.1"},
                           {"[conditions]\n", "source_level_spread_db", "-0.1", "0.0", "100.0", "100.1"},
                           {"[conditions]\n", "navigation_drift_m_per_sqrt_km", "-0.1", "0.0", "10000.0", "10000.1"},
                           {"[conditions]\n", "source_speed_mps", "-0.1", "0.0", "20.0", "20.1"},
                           {"[conditions]\n", "bearing_deg", "0.009", "0.01", "180.0", "180.1"},
                           {"[conditions]\n", "sources", "0", "1", "8", "9"},
                           {"[conditions]\n", "vehicle_speed_mps", "0.0099", "0.01", "20.0", "20.1"},
                           {"[conditions.current]\n", "speed_mps", "-0.1", "0.0", "20.0", "20.1"},
                           {current, "toward_deg", "-0.1", "0.0", "360.0", "360.1"},
                           {"[conditions.sound]\n", "lost_blocks", "-0.001", "0.0", "1.0", "1.001"},
                           {"[conditions.sound]\n", "self_noise_db_re_1upa_at_2mps", "-100.1", "-100.0", "300.0", "300.1"}}) {
    const auto complaint_of = [&](const std::string& value) { return complaint(limits.table + limits.key + " = " + value + "\n"); };
    EXPECT_NE(complaint_of(limits.below), "") << limits.key;
    EXPECT_EQ(complaint_of(limits.least), "") << limits.key;
    EXPECT_EQ(complaint_of(limits.most), "") << limits.key;
    EXPECT_NE(complaint_of(limits.above), "") << limits.key;
  }
}

TEST_F(ScenarioFile, IsRefusedForAKeyOutsideItsRange) {
  expect_refused("[conditions]\nfluctuation_db = -1.0\n", "conditions.fluctuation_db = -1.0: must be a finite number of at least 0");
  expect_refused("[conditions]\nfluctuation_db = 2.0\nleast_fluctuation_db = 3.0\n", "conditions.least_fluctuation_db = 3.0");
  expect_refused("[conditions]\nfloor_db = inf\n", "conditions.floor_db = inf: must be a finite number");
  expect_refused("[conditions.sound]\nlost_blocks = 1.5\n", "conditions.sound.lost_blocks = 1.5");
  expect_refused("[conditions]\nsources = 9\n", "conditions.sources = 9");
  expect_refused("[conditions]\nvehicle_speed_mps = 0.0078125\n",
                 "conditions.vehicle_speed_mps = 0.0078125: must be a finite number of at least 0.01 and at most 20");
  expect_refused("[conditions]\nwind = 3\n", "conditions.wind: unknown key");
  expect_refused("[conditions.current]\ntoward_deg = 10.0\n", "conditions.current.speed_mps is missing");
  expect_refused("[conditions.current]\nspeed_mps = 0.1\ntoward_deg = 400.0\n", "conditions.current.toward_deg = 400.0");
}

TEST_F(ScenarioFile, RefusesTimesOfCallsBelowAHundredthOfASecond) {
  const auto calls = [](const std::string& values) { return "[conditions]\nfloor_db = 5.0\n[conditions.calls]\n" + values; };
  const std::string rule = ": must be a finite number of at least 0.01 and at most 1000000";
  expect_refused(calls("interval_s = 0.0078125\nsong_s = 600.0\npause_s = 0.0\nlistening_s = 1.0\n"),
                 "conditions.calls.interval_s = 0.0078125" + rule);
  expect_refused(calls("interval_s = 15.0\nsong_s = 1e-300\npause_s = 0.0\nlistening_s = 1.0\n"),
                 "conditions.calls.song_s = 1e-300" + rule);
  expect_refused(calls("interval_s = 15.0\nsong_s = 600.0\npause_s = 0.0\nlistening_s = 2e6\n"),
                 "conditions.calls.listening_s = 2000000.0" + rule);
  EXPECT_EQ(complaint(calls("interval_s = 0.01\nsong_s = 0.01\npause_s = 0.0\nlistening_s = 0.01\n")), "");
}

TEST_F(ScenarioFile, IsRefusedForAnEmptyFileName) {
  expect_refused("[[oceans]]\nenvironment = \"\"\n", "oceans 1: environment = '': must be a text of at least one character");
  expect_refused("[field_library]\nfile = \"\"\n", "field_library.file = '': must be a text of at least one character");
}

TEST_F(ScenarioFile, HasRoomForAThousandOtherOceansAndLoadsNoneOfMore) {
  std::string oceans;
  for (int i = 0; i < 25'000; ++i) oceans += "[[oceans]]\nenvironment = \"none.toml\"\n";
  EXPECT_TRUE(support::tells(complaint(oceans), {"oceans", "25000 tables", "at most 1000"})) << complaint(oceans);
}

TEST_F(ScenarioFile, TurnsABearingsDegreesToRadiansAndRefusesAnAmbiguityOfNone) {
  EXPECT_FALSE(load("[conditions]\n").conditions.bearing.has_value());
  const auto clear = load("[conditions]\nbearing_deg = 180.0\n").conditions.bearing;
  ASSERT_TRUE(clear.has_value());
  EXPECT_EQ(clear->deviation, Radians{3.141592653589793});
  EXPECT_FALSE(clear->is_ambiguous);
  EXPECT_TRUE(load("[conditions]\nbearing_deg = 10.0\nbearing_ambiguous = true\n").conditions.bearing->is_ambiguous);
  expect_refused("[conditions]\nbearing_deg = nan\n", "conditions.bearing_deg = nan: must be a finite number");
  expect_refused("[conditions]\nbearing_ambiguous = true\n", "conditions.bearing_ambiguous = true: of use only with bearing_deg");
}

TEST_F(ScenarioFile, NeedsAFloorWhereCallsComeAndGo) {
  expect_refused("[conditions.calls]\ninterval_s = 15.0\nsong_s = 600.0\npause_s = 120.0\nlistening_s = 30.0\n",
                 "conditions.calls: need floor_db");
}

TEST_F(ScenarioFile, ListsOtherOceansRelativeToTheFile) {
  load("", "other.toml");
  const Scenario scenario = load("[[oceans]]\nenvironment = \"other.toml\"\n[[oceans]]\nenvironment = \"" + kMunk + "\"\n");
  EXPECT_EQ(scenario.other_oceans.size(), 2U);
  EXPECT_NE(scenario.environment.file_crc32, load("[[oceans]]\nenvironment = \"other.toml\"\n").environment.file_crc32)
      << "the checksum covers what the file names";
}

TEST_F(ScenarioFile, ChangesTheChecksumWithADataFileOfAnotherOcean) {
  const std::string text = R"(name = "other"
[source]
frequency_hz = 20.0
level_db_re_1upa_at_1m = 190.0
depth_m = 30.0
north_m = 0.0
east_m = 0.0
[noise]
level_db_re_1upa = 90.0
[water]
profile = "csv"
file = "cast.csv"
[seabed]
depth_m = 1000.0
[[seabed.layers]]
sound_speed_mps = 1600.0
)";
  std::ofstream(folder_ / "other.toml") << text;
  const auto checksum_with = [&](const std::string& deepest_mps) {
    std::ofstream(folder_ / "cast.csv") << "depth_m,sound_speed_mps\n0,1500\n1000," << deepest_mps << "\n";
    return load("[[oceans]]\nenvironment = \"other.toml\"\n").environment.file_crc32;
  };
  std::set<std::uint32_t> checksums;
  for (int speed = 1510; speed < 1574; ++speed) checksums.insert(checksum_with(std::to_string(speed)));
  EXPECT_EQ(load("[[oceans]]\nenvironment = \"other.toml\"\n").environment.files.back(), folder_ / "cast.csv");
  EXPECT_EQ(checksums.size(), 64U) << "of 64 numbers of 32 bits two are the same but for a chance of 5e-7";
  EXPECT_TRUE(checksums.contains(checksum_with("1510")));
}

TEST_F(ScenarioFile, ChangesTheChecksumWithTheFieldLibrary) {
  const auto checksum_with = [&](float last_loss_db) {
    write_library(folder_ / "library.nc", last_loss_db);
    return load("[field_library]\nfile = \"library.nc\"\n").environment.file_crc32;
  };
  EXPECT_NE(checksum_with(70.0F), checksum_with(71.0F));
  EXPECT_EQ(load("[field_library]\nfile = \"library.nc\"\n").environment.files.back(), folder_ / "library.nc");
}

TEST_F(ScenarioFile, RefusesAVastFieldLibraryByItsHeader) {
  write_library(folder_ / "library.nc", 70.0F);
  std::filesystem::resize_file(folder_ / "library.nc", std::uintmax_t{4} << 30U);  // sparse
  const std::uint64_t before = support::bytes_read();
  expect_refused("[field_library]\nfile = \"library.nc\"\n", "library.nc: has 4294967296 bytes, many more than its header promises");
  EXPECT_LT(support::bytes_read() - before, 1U << 20U);
}

TEST_F(ScenarioFile, RefusesAnOceanThatListsOthersOrHasConditions) {
  expect_refused("[[oceans]]\nenvironment = \"ocean.toml\"\n", "must be one ocean");  // itself
  load("[conditions]\nfluctuation_db = 1.0\n", "noisy.toml");
  expect_refused("[[oceans]]\nenvironment = \"noisy.toml\"\n", "must be one ocean");
  expect_refused("[[oceans]]\nenvironment = \"none.toml\"\n", "none.toml: no such file");
  const std::string named = complaint("\n[[oceans]]\nenvironment = \"none.toml\"\n");
  EXPECT_TRUE(named.starts_with((folder_ / "ocean.toml").string() + ":")) << named;
  EXPECT_NE(named.find(": oceans 1: environment: " + (folder_ / "none.toml").string() + ": no such file"), std::string::npos) << named;
}

TEST_F(ScenarioFile, DrawsAFamilyBetweenItsBoundsAndTheSameFromTheSameSeed) {
  const std::string table = R"(
[family]
members = 50
seed = 3
sea_floor_depth_m = [2000.0, 4000.0]
sediment_sound_speed_mps = [1450.0, 1650.0]
)";
  const auto members = load(table).other_oceans;
  ASSERT_EQ(members.size(), 50U);
  double shallowest = 1e9;
  double deepest = 0.0;
  for (const ocean::Environment& member : members) {
    shallowest = std::min(shallowest, member.seabed.depth.value);
    deepest = std::max(deepest, member.seabed.depth.value);
    EXPECT_EQ(std::get<ocean::MunkProfile>(member.water).axis_depth, Meters{1300.0}) << "has no bounds";
    EXPECT_EQ(member.noise_level, Decibels{90.0}) << "has no bounds";
    const double speed_mps = member.seabed.layers.back().sound_speed.value;
    EXPECT_TRUE(speed_mps >= 1450.0 && speed_mps <= 1650.0) << speed_mps;
  }
  // Of 50 uniform numbers the least lies in the lowest tenth but for a chance of 0.9^50 = 0.5 %; the seed is fixed.
  EXPECT_TRUE(shallowest >= 2000.0 && shallowest < 2200.0) << shallowest;
  EXPECT_TRUE(deepest <= 4000.0 && deepest > 3800.0) << deepest;
  EXPECT_EQ(load(table).other_oceans[7].seabed.depth, members[7].seabed.depth);
}

TEST_F(ScenarioFile, RefusesAFamilyThatCannotBeDrawn) {
  expect_refused("[family]\nsea_floor_depth_m = [2000.0, 4000.0]\n", "family.members is missing");
  expect_refused("[family]\nmembers = 3\nsea_floor_depth_m = [4000.0, 2000.0]\n", "must be [lowest, highest]");
  expect_refused("[family]\nmembers = 3\nsea_floor_depth_m = [20.0, 2000.0]\n",
                 "family.sea_floor_depth_m: must be more than source.depth_m");
  expect_refused("[family]\nmembers = 3\nsea_floor_depth_m = [30.0, 2000.0]\n", "must be more than source.depth_m");
  expect_refused("[field_library]\nfile = \"a.nc\"\n[family]\nmembers = 3\n", "field_library: cannot be there with family or oceans");
}

TEST_F(ScenarioFile, NamesTheOptionByWhichAWorldWasGivenForAnOcean) {
  const std::string rock = EARSHOT_SOURCE_DIR "/policy/worlds/rock.toml";
  const auto complaint_of = [&rock](const std::string& option) {
    try {
      (void)load_scenario(rock, option);
    } catch (const host::BadInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint_of("--environment").find("--environment " + rock + ": is a world"), 0U) << complaint_of("--environment");
  EXPECT_EQ(complaint_of("").find(rock + ": is a world"), 0U) << complaint_of("");
}

TEST_F(ScenarioFile, RefusesAFamilyOfAnOceanWhoseNumbersCannotBeDrawn) {
  const auto complaint_of = [this](const std::string& from, const std::string& to) {
    std::ifstream munk(kMunk);
    std::string text{std::istreambuf_iterator<char>(munk), {}};
    text.replace(text.find(from), from.size(), to);
    std::ofstream(folder_ / "other.toml") << text << "[family]\nmembers = 3\n";
    try {
      (void)load_scenario(folder_ / "other.toml");
    } catch (const host::BadInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint_of("axis_depth_m = 1300.0", "axis_depth_m = 0.5"), "");
  const std::string surface = complaint_of("axis_depth_m = 1300.0", "axis_depth_m = 0.0");
  EXPECT_TRUE(support::has_line(surface, {"family.members", "3", "water.axis_depth_m", "above 0"})) << surface;
  const std::string table =
      complaint_of("profile = \"munk\"", "profile = \"table\"\ndepth_m = [0.0, 3000.0]\nsound_speed_mps = [1500.0, 1520.0] #");
  EXPECT_TRUE(support::has_line(table, {"family.members", "3", "same"})) << table;
}

}  // namespace
}  // namespace earshot::search
