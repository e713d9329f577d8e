#include "tests/support/text/tells.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace earshot::support {
namespace {

constexpr std::string_view kComplaint = "FILE:21: search.depth_m = -300.5: must be a whole number from 0 to 120";

TEST(Tells, NamesEveryFactInTheOrderInWhichTheyAreGiven) {
  EXPECT_TRUE(tells(kComplaint, {"FILE:21", "search.depth_m", "-300.5", "0 to 120"}));
  EXPECT_FALSE(tells(kComplaint, {"search.depth_m", "FILE:21"}));
  EXPECT_FALSE(tells(kComplaint, {"search.depth_m", "121"}));
  EXPECT_TRUE(tells("a b a", {"a", "b", "a"}));
  EXPECT_FALSE(tells("a b", {"a", "b", "a"})) << "each stands behind the one before";
}

TEST(Tells, TakesNoPartOfANumberOrAWordForTheWhole) {
  for (const std::string_view part : {"2", "FILE:2", "00.5", "300.5", "-300", "5", "12", "hole"})
    EXPECT_FALSE(tells(kComplaint, {part})) << part;
  EXPECT_TRUE(tells("5", {"5"}));
  EXPECT_TRUE(tells("it is 5.", {"5"})) << "a full stop is no decimal point";
  EXPECT_TRUE(tells("0.1 5", {"5"})) << "the whole one stands behind the part";
  EXPECT_TRUE(tells("GRID-5", {"5"})) << "no minus sign";
}

TEST(Tells, SaysWhichFactIsNotTold) {
  EXPECT_STREQ(tells("a b", {"a", "c"}).message(), "\"c\" is not told, or not in its place: a b");
}

TEST(HasLine, WantsAllFactsInOneLine) {
  EXPECT_TRUE(has_line("a b\nc d\n", {"c", "d"}));
  EXPECT_FALSE(has_line("a b\nc d\n", {"b", "c"}));
  EXPECT_FALSE(has_line("", {"a"}));
}

TEST(LinesTell, WantsJustTheseLines) {
  EXPECT_TRUE(lines_tell("a b\nc d\n", {{"a"}, {"c", "d"}}));
  EXPECT_TRUE(lines_tell(std::vector<std::string>{"a b", "c d"}, {{"a"}, {"d"}}));
  EXPECT_FALSE(lines_tell("a b\nc d\n", {{"a"}})) << "one more";
  EXPECT_FALSE(lines_tell("a b\n", {{"a"}, {"c"}})) << "one less";
  EXPECT_FALSE(lines_tell("a b\nc d\n", {{"c"}, {"a"}}));
}

TEST(LastLine, IsWhatStandsBehindAllOthers) {
  EXPECT_EQ(last_line("a\nb\n"), "b");
  EXPECT_EQ(last_line(""), "");
}

}  // namespace
}  // namespace earshot::support
