#include "firmware/messages/health_words.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace earshot::messages {
namespace {

TEST(HealthWords, NameEveryStateAsTheMessagesDo) {
  EXPECT_STREQ(to_string(MissionState::kStandby), "STANDBY");
  EXPECT_STREQ(to_string(MissionState::kSearch), "SEARCH");
  EXPECT_STREQ(to_string(MissionState::kDone), "DONE");
  EXPECT_STREQ(to_string(MissionState::kAbort), "ABORT");
  EXPECT_STREQ(to_string(MissionState{200}), "?");
}

TEST(HealthWords, TellEveryReasonForAnEndApart) {
  std::set<std::string> words;
  const int last = static_cast<int>(kLastEndReason);
  for (int reason = 0; reason <= last; ++reason) words.insert(to_string(static_cast<EndReason>(reason)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(last) + 1);
  EXPECT_FALSE(words.contains("?"));
  EXPECT_STREQ(to_string(static_cast<EndReason>(last + 1)), "?");
  EXPECT_STREQ(to_string(EndReason::kOperatorAbort), "an operator aborted it");
  EXPECT_STREQ(to_string(EndReason::kLeftOperatingArea), "the vehicle left its operating area");
}

}  // namespace
}  // namespace earshot::messages
