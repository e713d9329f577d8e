#include "policy/tables/curves_plot.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/input_file.hpp"
#include "tests/firmware/policy/tables/made_up_tables.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::tables {
namespace {

std::string drawn(const policy::OceanTables& tables) {
  const support::TemporaryFolder folder;
  plot_curves(folder / "a.svg", tables);
  return host::read_text(folder / "a.svg", host::kAnySize);
}

TEST(CurvesPlot, NamesEveryOceanWhereTheyAreFew) {
  const std::string picture = drawn(policy::made_up_tables());
  for (const char* name :
       {"2 ocean tables: SNR of 20 Hz, vehicle at 300 m, sources at 10 to 50 m", "deep", "shelf", "detection threshold", "range (km)"})
    EXPECT_NE(picture.find(name), std::string::npos) << name;
}

TEST(CurvesPlot, NamesOfManyOnlyOneThatWeighsAsMuchAsAllOthersAndColoursThemByDepth) {
  policy::OceanTables tables = policy::made_up_tables();
  while (tables.tables.push_back(policy::made_up_table("it's $one_{more} \\n", 0.001F, 300.0F, {30, 20, 10})) == Status::kOk) {
  }
  const std::string picture = drawn(tables);
  EXPECT_NE(picture.find(">deep<"), std::string::npos);
  EXPECT_EQ(picture.find(">shelf<"), std::string::npos);
  EXPECT_NE(picture.find("sea floor (m)"), std::string::npos);
}

TEST(CurvesPlot, NamesNoneOfManyThatWeighTheSame) {
  policy::OceanTables tables = policy::made_up_tables();
  while (tables.tables.push_back(tables.tables[1]) == Status::kOk) {
  }
  for (policy::OceanTable& table : tables.tables) table.prior = 1.0F / static_cast<float>(tables.tables.size());
  EXPECT_EQ(drawn(tables).find(">deep<"), std::string::npos);
}

TEST(CurvesPlot, DrawsTablesOfOneRange) {
  policy::OceanTables tables = policy::made_up_tables();
  tables.range_count = 1;
  EXPECT_NE(drawn(tables).find("shelf"), std::string::npos);
}

TEST(CurvesPlot, TakesANameForTextWhateverGnuplotWouldReadInIt) {
  policy::OceanTables tables = policy::made_up_tables();
  tables.tables[0] = policy::made_up_table("it's $one_{more} `ls`", 0.1F, 300.0F, {30, 20, 10});
  EXPECT_NE(drawn(tables).find("$one_{more} `ls`"), std::string::npos);
}

}  // namespace
}  // namespace earshot::tables
