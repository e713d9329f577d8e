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
  EXPECT_EQ(nearest("rtain", kVerbs), "train");        // exchanged at the beginning
  EXPECT_EQ(nearest("trein", kVerbs), "train");        // another, in a word so short that two slips are too many
}

TEST(Suggestion, IsSilentWhereNothingIsNear) {
  EXPECT_EQ(nearest("swim", kVerbs), std::nullopt);
  EXPECT_EQ(nearest("", kVerbs), std::nullopt);
  EXPECT_EQ(nearest(std::string(100'000, 'a'), kVerbs), std::nullopt);
  EXPECT_EQ(did_you_mean("swim", kVerbs), "");
}

// In a word of four letters one slip is forgiven, and one letter that has moved beside another that is wrong makes two.
TEST(Suggestion, TakesNoHalfOfAnExchangeForOne) {
  EXPECT_EQ(nearest("tabc", std::vector<std::string>{"xtbc"}), std::nullopt);
  EXPECT_EQ(nearest("xtbc", std::vector<std::string>{"tabc"}), std::nullopt);
}

TEST(Suggestion, PrefersFewerSlips) {
  const std::vector<std::string> options{"--speed", "--seeds", "--seed"};
  EXPECT_EQ(did_you_mean("--sed", options), "; did you mean --seed?");
  const std::vector<std::string> nearest_first{"--seed", "--speeds"};
  EXPECT_EQ(nearest("--seeed", nearest_first), "--seed");
}

TEST(Suggestion, TakesTheFirstOfThoseThatAreEquallyNear) {
  const std::vector<std::string> options{"--seed", "--seen"};
  EXPECT_EQ(nearest("--see", options), "--seed");
}

}  // namespace
}  // namespace earshot::program
