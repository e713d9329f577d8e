#include "firmware/host/program/suggestion.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::program {
namespace {

const std::vector<std::string> kVerbs{"evaluate", "explain", "field", "fly", "train"};

TEST(Suggestion, FindsEachKindOfSlip) {
  EXPECT_EQ(nearest("feild", kVerbs), "field");        // two exchanged
  EXPECT_EQ(nearest("fild", kVerbs), "field");         // one missing
  EXPECT_EQ(nearest("trrain", kVerbs), "train");       // one too many
  EXPECT_EQ(nearest("explaim", kVerbs), "explain");    // another
  EXPECT_EQ(nearest("evalaute", kVerbs), "evaluate");  // exchanged further in
}

TEST(Suggestion, IsSilentWhereNothingIsNear) {
  EXPECT_EQ(nearest("swim", kVerbs), std::nullopt);
  EXPECT_EQ(nearest("", kVerbs), std::nullopt);
  EXPECT_EQ(nearest(std::string(100'000, 'a'), kVerbs), std::nullopt);
  EXPECT_EQ(did_you_mean("swim", kVerbs), "");
}

TEST(Suggestion, PrefersFewerSlips) {
  const std::vector<std::string> options{"--speed", "--seeds", "--seed"};
  EXPECT_EQ(did_you_mean("--sed", options), "; did you mean --seed?");
}

}  // namespace
}  // namespace earshot::program
