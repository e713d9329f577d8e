#include "policy/evaluate/output/csv.hpp"

#include <gtest/gtest.h>

namespace earshot::evaluate {
namespace {

TEST(CsvCell, QuotesOnlyWhatWouldBreakALine) {
  EXPECT_EQ(csv_cell("run 1/best.policy"), "run 1/best.policy");
  EXPECT_EQ(csv_cell(""), "");
  EXPECT_EQ(csv_cell("a,b.policy"), R"("a,b.policy")");
  EXPECT_EQ(csv_cell(R"(a"b.policy)"), R"("a""b.policy")");
  EXPECT_EQ(csv_cell("a\nb"), "\"a\nb\"");
  EXPECT_EQ(csv_cell("a\rb"), "\"a\rb\"");
}

}  // namespace
}  // namespace earshot::evaluate
