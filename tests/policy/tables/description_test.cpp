#include "policy/tables/description.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/firmware/policy/tables/made_up_tables.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::tables {
namespace {

TEST(TablesDescription, SaysHowFarEachIsHeard) {
  policy::OceanTables tables = policy::made_up_tables();
  tables.tables[0] = policy::made_up_table("deep", 0.75F, 3000.0F, {40, 19, 20});
  tables.tables[1] = policy::made_up_table("shelf", 0.25F, 200.0F, {127, 20, 19});
  EXPECT_EQ(heard_to(tables.tables[0], tables, Decibels{10.0}), Meters{200.0});
  EXPECT_EQ(heard_to(tables.tables[1], tables, Decibels{10.0}), Meters{100.0});
  EXPECT_LT(heard_to(tables.tables[1], tables, Decibels{64.0}).value, 0.0);
}

TEST(TablesDescription, HasALineForEachTable) {
  policy::OceanTables tables = policy::made_up_tables();
  tables.range_step = Meters{1'000.0};
  tables.tables[1] = policy::made_up_table("shelf", 0.25F, 200.0F, {19, -4, 19});
  ASSERT_EQ(tables.tables.push_back(policy::made_up_table("far", 1.0F, 4000.0F, {60, 30, 20})), Status::kOk);
  std::ostringstream out;
  describe(out, tables);
  EXPECT_TRUE(support::lines_tell(out.str(), {{"20 Hz", "heard", "300 m", "10 to 50 m", "200 to 4000 m", "3 ranges", "1000 m"},
                                              {"floor", "prior", "detected to (km)"},
                                              {"3000", "0.750", "0.0"},
                                              {"200", "0.250"},
                                              {"4000", "1.000", "2.0"},
                                              {"detected: an SNR of 10 dB or more"}}));
  EXPECT_FALSE(support::has_line(out.str(), {"bytes of a name"}));
}

TEST(TablesDescription, StatesThatAFileHoldsTheBeginningOfALongNameAlone) {
  policy::OceanTables tables = policy::made_up_tables();
  tables.tables[0] = policy::made_up_table("Munk profile over a flat floor: ", 0.75F, 3000.0F, {40, 19, 20});  // 32 bytes
  std::ostringstream out;
  describe(out, tables);
  EXPECT_TRUE(support::has_line(out.str(), {"holds 32 bytes of a name"})) << out.str();
}

}  // namespace
}  // namespace earshot::tables
