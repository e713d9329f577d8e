#include "policy/report/page/page_template.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace earshot::report {
namespace {

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return "";
  const std::size_t at = from + begin.size();
  return text.substr(at, text.find(end, at) - at);
}

TEST(FlightPage, IsOneFileThatAsksNobodyForAnything) {
  const std::string page(page_template());
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  for (const char* outside : {" src=\"http", "url(http", "@import", "<!--style-->", "<!--script-->"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_NE(page.find("Leaflet"), std::string::npos) << "the licences of the libraries stay";
  EXPECT_NE(page.find("Chart.js"), std::string::npos);
}

TEST(FlightPage, RunsNoScriptButItsOwn) {
  const std::string page(page_template());
  EXPECT_TRUE(std::regex_search(page, std::regex("script-src 'sha256-[A-Za-z0-9+/]{43}='")));
  EXPECT_EQ(page.find("script-src 'unsafe"), std::string::npos);
}

TEST(FlightPage, HoldsAShortFlightAsItIsButForWhatWouldEndTheScript) {
  const std::string page = page_with(R"({"name": "</script><!-- <b>"})");
  EXPECT_EQ(between(page, R"(<script id="flight" type="application/json">)", "</script>"),
            R"({"name": "\u003c/script>\u003c!-- \u003cb>"})");
  EXPECT_TRUE(page.ends_with("</html>\n"));
}

TEST(FlightPage, HoldsASuiteAndARunOfTheBenchUnderTheirOwnNames) {
  EXPECT_EQ(between(page_with("[1]", PageOf::kSuite), R"(<script id="suite" type="application/json">)", "</script>"), "[1]");
  EXPECT_EQ(between(page_with("[1]", PageOf::kBench), R"(<script id="bench" type="application/json">)", "</script>"), "[1]");
}

/// The gzip header is 1f 8b 08 (RFC 1952), "H4sI" in base64; a browser's test opens one (flight_page.in_a_browser).
TEST(FlightPage, CompressesALongFlight) {
  const std::string page = page_with("\"" + std::string(1'000'000, 'a') + "\"");
  EXPECT_TRUE(between(page, R"(<script id="flight" type="application/gzip">)", "</script>").starts_with("H4sI"));
  EXPECT_LT(page.size(), page_template().size() + 3'000);
}

// The vectors of RFC 4648, section 10, and the two last digits.
TEST(Base64, IsThatOfItsStandard) {
  constexpr std::pair<std::string_view, std::string_view> kVectors[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [text, encoded] : kVectors) EXPECT_EQ(base64(std::vector<std::uint8_t>(text.begin(), text.end())), encoded);
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xFF, 0xEF, 0xBE}), "/+++");
}

}  // namespace
}  // namespace earshot::report
