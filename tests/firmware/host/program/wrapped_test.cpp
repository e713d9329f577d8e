#include "firmware/host/program/wrapped.hpp"

#include <gtest/gtest.h>

namespace earshot::program {
namespace {

const std::string kNinetyEight(98, 'x');

TEST(Wrapped, BreaksBetweenWordsBeforeALineIsWiderThanAHundredColumns) {
  EXPECT_EQ(wrapped(kNinetyEight + " a b", 0, 4), kNinetyEight + " a\n    b");
  EXPECT_EQ(wrapped("a " + kNinetyEight, 0, 4), "a " + kNinetyEight);
  EXPECT_EQ(wrapped("a " + kNinetyEight, 1, 4), "a\n    " + kNinetyEight) << "of a line that has begun";
}

TEST(Wrapped, LeavesAWordWholeThatIsWiderThanALine) {
  const std::string path(120, 'p');
  EXPECT_EQ(wrapped("in " + path + " there", 0, 2), "in\n  " + path + "\n  there");
}

TEST(Wrapped, BreaksEachLineOfATextByItself) {
  EXPECT_EQ(wrapped_lines("a b\n" + kNinetyEight + " c d"), "a b\n" + kNinetyEight + " c\n  d\n");
  EXPECT_EQ(wrapped_lines("a\n\nb\n"), "a\n\nb\n");
}

TEST(Wrapped, TakesManyBlanksForOneAndNothingForNothing) {
  EXPECT_EQ(wrapped("  a   b ", 10, 2), "a b");
  EXPECT_EQ(wrapped("", 10, 2), "");
}

}  // namespace
}  // namespace earshot::program
