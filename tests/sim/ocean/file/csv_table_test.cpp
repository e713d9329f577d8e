#include "sim/ocean/file/csv_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::ocean {
namespace {

class CsvTableFile : public testing::Test {
 protected:
  CsvTable read(const std::string& text) {
    std::ofstream(folder_ / "t.csv") << text;
    return CsvTable(folder_ / "t.csv");
  }
  std::string complaint(const std::string& text) {
    try {
      (void)read(text);
    } catch (const host::BadInput& e) {
      return std::string(e.what()).substr(folder_.path().string().size() + 1);
    }
    return "no error";
  }
  support::TemporaryFolder folder_;
};

TEST_F(CsvTableFile, ReadsWhatSpreadsheetsWrite) {
  const CsvTable table = read("\xEF\xBB\xBF# a cast\r\ndepth_m, \"sound_speed_mps\"\r\n0,1500\r\n\r\n  10 ,\t1.49e3\r\n");
  EXPECT_EQ(table.column("depth_m"), (std::vector<double>{0.0, 10.0}));
  EXPECT_EQ(table.column("sound_speed_mps"), (std::vector<double>{1500.0, 1490.0}));
  EXPECT_FALSE(table.has("temperature_c"));
}

TEST_F(CsvTableFile, SaysWhereAValueIsMissingOrNoNumber) {
  EXPECT_TRUE(support::tells(complaint("a,b\n1,2\n3,\n"), {"t.csv:3", "b", "nothing"}));
  EXPECT_TRUE(support::tells(complaint("a,b\n1,nan\n"), {"t.csv:2", "b", "nan"}));
  EXPECT_TRUE(support::tells(complaint("a,b\n1e999,2\n"), {"t.csv:2", "a", "1e999"}));
  EXPECT_TRUE(support::tells(complaint("a,b\n1,12abc\n"), {"t.csv:2", "b", "12abc"}));
  EXPECT_EQ(complaint("a,b\n1\n"), "t.csv:2: has 1 values, the header has 2");
  EXPECT_EQ(complaint("a,b,a\n1,2,3\n"), "t.csv: has two columns a");
  EXPECT_TRUE(support::tells(complaint("a,b\n"), {"t.csv", "header", "line", "at least"}));
}

TEST_F(CsvTableFile, NamesTheColumnsItHasWhenOneIsMissing) {
  const CsvTable table = read("a,b\n1,2\n");
  try {
    (void)table.column("depth_m");
    FAIL();
  } catch (const host::BadInput& e) {
    EXPECT_NE(std::string(e.what()).find("must have a column depth_m, has: a, b"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace earshot::ocean
