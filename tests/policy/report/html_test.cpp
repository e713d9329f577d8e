#include "policy/report/html.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::report {
namespace {

/// The rules between "@media <query> {" and its closing brace in the first column.
std::string rules_for(const std::string& query) {
  const std::string head = html_head("a page");
  const std::size_t at = head.find("@media " + query + " {\n");
  return at == std::string::npos ? "" : head.substr(at, head.find("\n}\n", at) - at);
}

TEST(Html, CutsNoTableOnPaperAndPrintsItDarkOnLight) {
  EXPECT_NE(rules_for("print").find(".table { overflow: visible; }"), std::string::npos);
  EXPECT_NE(rules_for("print").find("print-color-adjust: exact"), std::string::npos) << "bars are backgrounds, which browsers leave out";
  EXPECT_EQ(html_head("a page").find("@media (prefers-color-scheme: dark)"), std::string::npos) << "a dark page is for screens alone";
}

TEST(Html, UnfoldsItsReasonsBeforeItIsPrinted) {
  EXPECT_NE(html_head("a page").find("<body onbeforeprint=\"for (const part of document.querySelectorAll('details')) part.open = true\">"),
            std::string::npos);
}

TEST(Html, TurnsDecisionsIntoAListOfNamedCellsOnANarrowScreen) {
  EXPECT_NE(html_head("a page").find("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"), std::string::npos);
  const std::string narrow = rules_for("screen and (max-width: 40rem)");
  EXPECT_NE(narrow.find("tr.step { display: grid;"), std::string::npos);
  EXPECT_NE(narrow.find("td[data-name]::before { content: attr(data-name);"), std::string::npos);
  EXPECT_NE(narrow.find("tr.why, tr.why > td { display: block;"), std::string::npos) << "sentences and charts as wide as the screen";
  EXPECT_NE(narrow.find(".actions > thead { display: none; }"), std::string::npos) << "the cells of a direction name themselves, too";
  EXPECT_NE(html_head("a page").find("overflow-wrap: anywhere"), std::string::npos) << "a path has no space to break at";
}

TEST(Html, DrawsABarForAChoiceToTheRightOfTheMiddleAndOneAgainstItToTheLeft) {
  EXPECT_EQ(signed_bar_cell(0.5), "<td class=\"part\"><b><i class=\"for\" style=\"--share:0.500\"></i></b></td>");
  EXPECT_EQ(signed_bar_cell(-0.25), "<td class=\"part\"><b><i class=\"against\" style=\"--share:0.250\"></i></b></td>");
  const std::string head = html_head("a page");
  EXPECT_NE(head.find(".for { left: 50%;"), std::string::npos);
  EXPECT_NE(head.find(".against { right: 50%;"), std::string::npos);
}

TEST(Html, DrawsNoBarForAShareThatIsWrittenAsZero) {
  EXPECT_EQ(percent_cell("NE", 0.004, false), "<td data-name=\"NE\" class=\"p\">0</td>");
  EXPECT_EQ(percent_cell("NE", 0.9249, true), "<td data-name=\"NE\" class=\"p taken\"><i style=\"--share:0.925\"></i>92</td>");
}

}  // namespace
}  // namespace earshot::report
