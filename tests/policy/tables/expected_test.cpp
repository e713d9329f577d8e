#include "policy/tables/expected.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::tables {
namespace {

OceanCurve curve(const std::string& name, double weight, double snr_db) {
  return {
      .name = name, .detail = "", .weight = weight, .sea_depth = Meters{1000.0}, .source_depth = Meters{30.0}, .snr_db = {snr_db, snr_db}};
}

std::string words(const Merged& merged) {
  std::string all;
  for (const OceanCurve& c : merged.curves) all += c.name + " " + std::to_string(c.weight).substr(0, 4) + " ";
  return all;
}

TEST(Expected, WeighAsMuchAsAllOthersTogether) {
  const std::vector<OceanCurve> others{curve("a", 1, 10), curve("b", 4, 20), curve("c", 1, 30)};
  EXPECT_EQ(words(merge_beside({.expected = {curve("x", 1, 40)}}, others, 4)), "x 6.00 a 1.00 b 4.00 c 1.00 ");
  // Two that weigh 0.5 and 1.5 share it as 1 to 3.
  EXPECT_EQ(words(merge_beside({.expected = {curve("x", 0.5, 40), curve("y", 1.5, 41)}}, others, 5)),
            "x 1.50 y 4.50 a 1.00 b 4.00 c 1.00 ");
}

TEST(Expected, AreNotMergedHoweverMuchAlike) {
  // The two expected are the same, and the same as a; only b and c, 10 dB apart, may become one.
  const std::vector<OceanCurve> others{curve("a", 1, 50), curve("b", 1, 10), curve("c", 1, 20)};
  const Merged merged = merge_beside({.expected = {curve("x", 1, 50), curve("y", 1, 50)}}, others, 4);
  EXPECT_EQ(words(merged), "x 1.50 y 1.50 a 1.00 b 2.00 ");
  EXPECT_EQ(merged.curves[0].snr_db, (std::vector<double>{50, 50}));
  EXPECT_EQ(merged.most_difference_db, 5.0);  // b and c, from 15 dB
}

TEST(Expected, HaveVariantsEachOfWhichWeighsAsMuchAsOneOfTheOthersOnTheMean) {
  const std::vector<OceanCurve> others{curve("a", 1, 10), curve("b", 2, 20)};
  // The two others weigh 3, so the two variants 3, shared as 1 to 2, and what is expected 6; the variants are as alike as x and y are.
  const Unmerged unmerged{.expected = {curve("x", 1, 40)}, .variants = {curve("y", 1, 40), curve("z", 2, 40)}};
  EXPECT_EQ(words(merge_beside(unmerged, others, 5)), "x 6.00 y 1.00 z 2.00 a 1.00 b 2.00 ");
  // Merged, there is one other.
  EXPECT_EQ(words(merge_beside(unmerged, others, 4)), "x 9.00 y 2.00 z 4.00 b 3.00 ");
  EXPECT_EQ(words(merge_beside(unmerged, {}, 3)), "x 3.00 y 1.00 z 2.00 ");
}

TEST(Expected, StandAloneWhereThereAreNoOthers) {
  EXPECT_EQ(words(merge_beside({.expected = {curve("x", 0.5, 40)}}, {}, 1)), "x 0.50 ");
}

TEST(Expected, ChangeNothingWhereThereAreNone) {
  EXPECT_EQ(words(merge_beside({}, {curve("a", 1, 10), curve("b", 2, 11)}, 1)), "b 3.00 ");
}

TEST(Expected, AreRefusedWhereTheyLeaveNoRoomForOthers) {
  const Unmerged two{.expected = {curve("x", 1, 40)}, .variants = {curve("y", 1, 10)}};
  EXPECT_THROW((void)merge_beside(two, {curve("a", 1, 10)}, 2), host::BadInput);
  EXPECT_EQ(words(merge_beside(two, {}, 2)), "x 1.00 y 1.00 ");
  EXPECT_THROW((void)merge_beside(two, {}, 1), host::BadInput);
}

}  // namespace
}  // namespace earshot::tables
