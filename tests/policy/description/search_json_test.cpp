#include "policy/description/search_json.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::description {
namespace {

using Json = nlohmann::ordered_json;

Json simple() {
  return Json::parse(
      R"({"observation":[{"feature":1,"age":0,"offset":12500.0,"scale":8e-05},{"feature":2,"age":0,"offset":12500.0,"scale":8e-05}],
    "direction_count":8,"step_length_m":1000.0,"area_north_m":25000.0,"area_east_m":20000.0,"detection_threshold_db":10.0,
    "provenance":{"seed":"1","command":"earshot-train"}})");
}

std::string fault_of(const Json& json) {
  try {
    (void)read(json);
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "accepted";
}

TEST(SearchJson, IsReadAndWrittenBackKeyByKey) {
  Json written;
  write(read(simple()), written);
  EXPECT_EQ(written["area_east_m"], 20'000.0);
  EXPECT_EQ(written["direction_count"], 8);
  EXPECT_EQ(written["observation"].size(), 2U);
  EXPECT_EQ(written["provenance"], simple()["provenance"]) << "in the order written";
  EXPECT_FALSE(written.contains("listening")) << "of the newest SNR nothing need be said";
}

TEST(SearchJson, RefusesAWholeNumberThatAnIntegerWouldWrap) {
  Json json = simple();
  json["direction_count"] = 4'294'967'304ULL;  // 2^32 + 8
  EXPECT_NE(fault_of(json).find("direction_count: must be a whole number"), std::string::npos);
  json["direction_count"] = 8.5;
  EXPECT_NE(fault_of(json).find("direction_count: must be a whole number"), std::string::npos);
}

TEST(SearchJson, RefusesALengthThatIsNone) {
  Json json = simple();
  json["step_length_m"] = 0.0;
  EXPECT_EQ(fault_of(json), "step_length_m: must be above 0");
}

TEST(SearchJson, RefusesAFeatureThatNobodyKnows) {
  Json json = simple();
  json["observation"][1]["feature"] = 200;
  EXPECT_EQ(fault_of(json), "observation: unknown feature");
  json["observation"] = Json::array();
  EXPECT_EQ(fault_of(json), "observation: has no elements");
}

}  // namespace
}  // namespace earshot::description
