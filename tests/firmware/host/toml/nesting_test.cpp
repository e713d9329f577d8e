#include "firmware/host/toml/nesting.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::host {
namespace {

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

TEST(Nesting, AllowsThirtyTwoAndNoMore) {
  EXPECT_EQ(line_nested_too_deep("a" + repeated(".a", 32) + " = 1"), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("a" + repeated(".a", 33) + " = 1"), 1U);
  EXPECT_EQ(line_nested_too_deep("a = " + repeated("[", 32) + repeated("]", 32)), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("a = " + repeated("[", 33) + repeated("]", 33)), 1U);
  EXPECT_EQ(line_nested_too_deep("b = 1.5\na" + repeated(".a", 32) + " = 1"), std::nullopt) << "counted from the line's beginning";
  EXPECT_EQ(line_nested_too_deep("\n\n[a" + repeated(".a", 33) + "]"), 3U);
}

TEST(Nesting, CountsInlineTablesAndQuotedKeys) {
  EXPECT_EQ(line_nested_too_deep("a = " + repeated("{a = ", 33) + "1" + repeated("}", 33)), 1U);
  EXPECT_EQ(line_nested_too_deep("\"a\"" + repeated(".\"a\"", 33) + " = 1"), 1U);
}

TEST(Nesting, DoesNotCountOneAfterAnother) {
  EXPECT_EQ(line_nested_too_deep(repeated("[[a.b]]\nx = [1.5, {y.z = [2.5]}]\n", 1000)), std::nullopt);
  EXPECT_EQ(line_nested_too_deep("a = [" + repeated("1.5, ", 1000) + "]"), std::nullopt);
}

TEST(Nesting, DoesNotCountWhatIsText) {
  const std::string deep = repeated("[.", 40);
  for (const std::string& text : {"a = \"" + deep + "\"", "a = '" + deep + "'", "a = \"\"\"\n" + deep + "\n\"\"\"",
                                  "a = '''\n" + deep + "\n'''", "# " + deep, "a = \"\\\"" + deep + "\"", "a = 1 # \"\n# " + deep}) {
    EXPECT_EQ(line_nested_too_deep(text), std::nullopt) << text;
  }
}

TEST(Nesting, IsNotHiddenBehindTheEndOfAText) {
  for (const char* text : {R"("")", R"("\\")", "''", R"('\')", R"("""""")", R"("""x"""")", R"("""x""""")", "'''x'''''"}) {
    EXPECT_EQ(line_nested_too_deep("b = {c = " + std::string(text) + ", a" + repeated(".a", 40) + " = 1}"), 1U) << text;
  }
}

TEST(Nesting, SeesTheLineAfterATextThatNeverEnds) {
  EXPECT_EQ(line_nested_too_deep("a = \"x\na" + repeated(".a", 40) + " = 1"), 2U);
}

}  // namespace
}  // namespace earshot::host
