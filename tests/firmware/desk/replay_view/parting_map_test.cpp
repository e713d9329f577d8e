#include "firmware/desk/replay_view/parting_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/firmware/desk/replay_view/known_decisions.hpp"

namespace earshot::replay_view {
namespace {

const Rectangle kArea{.south_west = {}, .north_east = {Meters{25'000}, Meters{25'000}}};

// The flight and a kilometre about it: 11 to 14 km either way. A side of 640 stands for 1.08 x 3 km = 3.24 km about 12.5 km: 12 km east is
// x = 90 + 640 (12 - 10.88) / 3.24 = 311.23, 12 km north y = 60 + 640 - 221.23 = 478.77; a kilometre is 197.53. The area is all of it.
TEST(PartingMap, DrawsTrackBothDecisionsAndWhereTheyPartWhereTheyBelong) {
  Counterfactual counterfactual;
  counterfactual.track = {{Meters{12'000}, Meters{12'000}}, {Meters{13'000}, Meters{12'000}}};
  const std::array then{decision_to(0, 2, 13'000, 12'000)};
  const std::array now{decision_to(0, 2, 12'000, 13'000)};
  const std::string svg = parting_map(counterfactual, paired(then, now), 0, kArea, "a & b");
  EXPECT_NE(svg.find("points=\"311.23,478.77 311.23,281.23\" fill=\"none\" stroke=\"#5b6b78\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("points=\"311.23,478.77 311.23,281.23\" fill=\"none\" stroke=\"#0b57a4\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("points=\"311.23,478.77 508.77,478.77\" fill=\"none\" stroke=\"#d55e00\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("<circle cx=\"311.23\" cy=\"478.77\" r=\"12\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("<polygon points=\"90.00,700.00 90.00,60.00 730.00,60.00 730.00,700.00\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("they part at step 0"), std::string::npos);
  EXPECT_NE(svg.find("nothing is predicted after it:"), std::string::npos);
  EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
}

TEST(PartingMap, MarksWhereTheyPartThoughItDrawsLaterStepsAlone) {
  const std::array then{decision_to(0, 2, 13'000, 12'000), decision_to(1, 500, 12'000, 13'000)};
  const std::vector<StepPair> pairs = paired(then, std::span(then).last(1));
  const std::string north = "points=\"311.23,478.77 311.23,281.23\"";
  EXPECT_NE(parting_map({}, pairs, 0, kArea, "").find(north), std::string::npos);
  const std::string svg = parting_map({}, pairs, 1, kArea, "");
  EXPECT_EQ(svg.find(north), std::string::npos) << svg;
  EXPECT_NE(svg.find("points=\"311.23,478.77 508.77,478.77\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("<circle cx=\"311.23\" cy=\"478.77\" r=\"12\""), std::string::npos) << svg;
  EXPECT_NE(svg.find("they part at step 0"), std::string::npos);
}

TEST(PartingMap, OfDecisionsThatDoNotPartMarksNone) {
  const std::array same{decision_to(0, 2, 13'000, 12'000)};
  const std::string svg = parting_map({}, paired(same, same), 0, kArea, "");
  EXPECT_EQ(svg.find("they part"), std::string::npos);
  EXPECT_NE(svg.find("the decisions do not part"), std::string::npos);
}

}  // namespace
}  // namespace earshot::replay_view
