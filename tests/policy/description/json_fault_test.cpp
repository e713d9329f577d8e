#include "policy/description/json_fault.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "policy/description/search_description.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::description {
namespace {

std::string said_of(const auto& work) {
  try {
    work();
  } catch (const nlohmann::json::exception& fault) {
    return to_string(fault);
  }
  return "no fault";
}

TEST(JsonFault, NamesTheByteWhereItIsNoJson) {
  EXPECT_EQ(said_of([] { const auto json = nlohmann::json::parse("{\"a\": x}"); }), "not JSON from byte 7 on, or cut short");
}

TEST(JsonFault, NamesTheKeyThatIsNotThere) {
  EXPECT_EQ(said_of([] { (void)nlohmann::json::parse("{}").at("seed"); }), "has no \"seed\"");
}

TEST(JsonFault, SaysWhichKindOfValueBelongsThere) {
  EXPECT_EQ(said_of([] { (void)nlohmann::json("ten").get<int>(); }), "holds a text where a number belongs");
  EXPECT_EQ(said_of([] { (void)nlohmann::json::parse("[]").get<std::string>(); }), "holds a list where a text belongs");
  EXPECT_TRUE(support::tells(said_of([] { (void)nlohmann::json().get<bool>(); }), {"holds", "nothing", "true", "false belongs"}));
}

TEST(JsonFault, KeepsTheLibrarysWordsFromTheReader) {
  EXPECT_EQ(said_of([] { (void)nlohmann::json(1).at("seed"); }), "does not hold what belongs there");
  EXPECT_EQ(said_of([] { (void)nlohmann::json::parse("[]").at(3); }), "does not hold what belongs there");
  for (const char* text : {"", "{", "[1]", "{\"format\": 1}", "{\"observation\": []}"}) {
    try {
      (void)from_text(text);
      ADD_FAILURE() << text;
    } catch (const host::BadInput& bad) {
      EXPECT_EQ(std::string(bad.what()).find("json.exception"), std::string::npos) << bad.what();
    }
  }
}

}  // namespace
}  // namespace earshot::description
