#include "policy/own_search/template_text.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::own_search {
namespace {

const char* const kText =
    "# A file that ships.\n# In two lines.\n\nname = \"old # name\"   # of it\n\n[area]  # where\ndepth_m = 1.0\n\n"
    "[[port]]\nkind = \"can\"\n\n[[port]]\nkind = \"lcm\"\nurl = \"udpm\"    # where to\n\n[policy]\n# depth_m = 3.0\n";

TemplateText shipped() {
  return {kText, "shipped.toml"};
}

TEST(TemplateText, ChangesOneValueAndNoOtherByte) {
  TemplateText text = shipped();
  text.set("area", "depth_m", "25.5");
  std::string expected = kText;
  EXPECT_EQ(text.text(), expected.replace(expected.find("1.0"), 3, "25.5"));
}

TEST(TemplateText, LeavesTheCommentBehindAValueInItsColumn) {
  TemplateText text = shipped();
  text.set("", "name", "\"new\"");
  EXPECT_NE(text.text().find("\nname = \"new\"          # of it\n"), std::string::npos) << text.text();
}

TEST(TemplateText, PutsAValueThatReachesTheCommentBeforeIt) {
  TemplateText text = shipped();
  text.set("", "name", "\"a name much longer than before\"");
  EXPECT_TRUE(support::has_line(text.text(), {"name", "a name much longer than before"})) << text.text();
}

TEST(TemplateText, FindsAKeyInTheTableThatHasIt) {
  TemplateText text = shipped();
  text.set("[port]", "url", "\"mine\"");
  EXPECT_NE(text.text().find("kind = \"lcm\"\nurl = \"mine\"    # where to\n"), std::string::npos) << text.text();
}

TEST(TemplateText, RefusesAKeyThatStandsInAnotherTableOrAsARemark) {
  TemplateText text = shipped();
  EXPECT_THROW(text.set("area", "kind", "1"), host::BadInput);
  EXPECT_THROW(text.set("policy", "depth_m", "1"), host::BadInput);
}

TEST(TemplateText, ReplacesTheCommentBeforeTheFirstEmptyLine) {
  TemplateText text = shipped();
  text.set_heading("# Mine.");
  EXPECT_TRUE(text.text().starts_with("# Mine.\n\nname = ")) << text.text();
}

TEST(TomlNumber, IsAlwaysAFraction) {
  EXPECT_EQ(toml_number(300.0), "300.0");
  EXPECT_EQ(toml_number(-0.25), "-0.25");
  EXPECT_EQ(toml_number(38.123456789), "38.123456789");
}

TEST(TomlText, KeepsQuotesAndBackslashesWithinItsQuotes) {
  EXPECT_EQ(toml_text(R"(a "b" \c)"), R"("a \"b\" \\c")");
}

}  // namespace
}  // namespace earshot::own_search
