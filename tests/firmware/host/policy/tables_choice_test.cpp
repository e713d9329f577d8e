#include "firmware/host/policy/tables_choice.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/firmware/policy/tables/made_up_tables.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

struct Kind {
  double frequency_hz = 20.0;
  double depth_m = 300.0;
  std::uint16_t ranges = 3;  // every 100 m
};

class TablesChoice : public testing::Test {
 protected:
  fs::path write(const std::string& name, const Kind& kind) {
    policy::OceanTables tables = policy::made_up_tables();
    tables.frequency = Hertz{kind.frequency_hz};
    tables.receiver_depth = Meters{kind.depth_m};
    tables.range_count = kind.ranges;
    const fs::path path = folder_ / name;
    support::write_bytes(path, support::signed_bytes(tables));
    return path;
  }

  /// The name of the file in the folder that is chosen for the sound, or what is said.
  std::string chosen(const policy::SearchedSound& sound) { return chosen({folder_.path()}, sound); }
  static std::string chosen(const std::vector<fs::path>& named, const policy::SearchedSound& sound) {
    try {
      return tables_for(named, sound, "a.toml").path.filename();
    } catch (const BadInput& e) {
      return e.what();
    }
  }
  static policy::SearchedSound sound(double depth_m, double frequency_hz = 20.0, double furthest_m = 200.0) {
    return {.vehicle_depth = Meters{depth_m}, .frequency = Hertz{frequency_hz}, .furthest = Meters{furthest_m}};
  }

  const support::TemporaryFolder folder_;
};

TEST_F(TablesChoice, IsTheFileThatCoversDepthFrequencyAndReach) {
  write("a.tables", {.depth_m = 100.0});
  write("b.tables", {.depth_m = 300.0});
  write("c.tables", {.frequency_hz = 35.0, .depth_m = 300.0});
  write("d.tables", {.depth_m = 300.0, .ranges = 6});
  EXPECT_EQ(chosen(sound(109.0)), "a.tables");
  EXPECT_EQ(chosen(sound(280.0)), "b.tables");
  EXPECT_EQ(chosen(sound(280.0, 36.0)), "c.tables");
  EXPECT_EQ(chosen(sound(280.0, 20.0, 500.0)), "d.tables");
}

TEST_F(TablesChoice, IsOfSeveralTheOneOfTheNearestDepthThenFrequencyThenTheFirst) {
  write("a.tables", {.depth_m = 100.0});
  write("b.tables", {.depth_m = 110.0});
  write("c.tables", {.frequency_hz = 20.5, .depth_m = 110.0});
  write("d.tables", {.frequency_hz = 20.5, .depth_m = 110.0});
  EXPECT_EQ(chosen(sound(104.0)), "a.tables");  // 4 % from the one, 5.8 % from the other
  EXPECT_EQ(chosen(sound(105.5)), "b.tables");  // 5.5 % and 4.3 %
  EXPECT_EQ(chosen(sound(105.5, 20.4)), "c.tables");
}

TEST_F(TablesChoice, SaysWhatWasAskedAndAllThereIs) {
  write("a.tables", {.depth_m = 300.0});
  write("b.tables", {.depth_m = 30.0});
  write("c.tables", {.frequency_hz = 35.0, .depth_m = 100.0, .ranges = 6});
  const std::string there_is =
      "none of the tables are of that, but 20 Hz at 30, 300 m as far as 200 m; 35 Hz at 100 m as far as 500 m (depths within 10 %, "
      "frequencies within 5 %); earshot tables makes others, and earshot init --depth-m M --frequency-hz F a search with a README on how "
      "to do it";
  EXPECT_TRUE(support::tells(chosen(sound(100.0)), {"a.toml", "20 Hz", "100 m", "200 m", there_is}));
  EXPECT_TRUE(support::tells(chosen(sound(100.0, 35.0, 35'355.5)), {"a.toml", "35 Hz", "100 m", "35355.5 m", there_is}));
}

TEST_F(TablesChoice, TakesFilesAndFolders) {
  write("b.tables", {.depth_m = 100.0});
  const support::TemporaryFolder other;
  const fs::path moved = other / "c.tables";
  fs::rename(write("c.tables", {.depth_m = 300.0}), moved);
  EXPECT_EQ(chosen({folder_.path(), moved}, sound(100.0)), "b.tables");
  EXPECT_EQ(chosen({folder_.path(), moved}, sound(300.0)), "c.tables");
}

TEST_F(TablesChoice, GivesTheBytesToWhoChecksTheirSignature) {
  const std::vector<fs::path> named{write("a.tables", {})};
  const TablesFile file = tables_for(named, sound(300.0), "a.toml");
  EXPECT_EQ(file.bytes, support::signed_bytes(policy::made_up_tables()));
  EXPECT_EQ(file.tables->tables.size(), 2U);
}

TEST_F(TablesChoice, RefusesAFolderWithoutTablesAndOneWithADamagedFileByName) {
  support::write_bytes(folder_ / "a.txt", {1, 2, 3});
  EXPECT_EQ(chosen(sound(300.0)), folder_.path().string() + ": holds no ocean tables (.tables)");
  write("a.tables", {});
  support::write_bytes(folder_ / "b.tables", {1, 2, 3});
  EXPECT_EQ(chosen(sound(300.0)), (folder_ / "b.tables").string() + ": is cut short");
  EXPECT_EQ(chosen({folder_ / "none.tables"}, sound(300.0)), (folder_ / "none.tables").string() + ": no such file");
}

}  // namespace
}  // namespace earshot::host
