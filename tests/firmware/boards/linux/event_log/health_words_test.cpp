#include "firmware/boards/linux/event_log/health_words.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::board {
namespace {

TEST(HealthWords, TellStateReasonAndSteps) {
  messages::Health health;
  health.state = messages::MissionState::kDone;
  health.end_reason = messages::EndReason::kCompleted;
  health.steps_taken = 37;
  EXPECT_EQ(to_string(health), "DONE, completed, the source is reached, after 37 steps");
}

TEST(HealthWords, TellNoReasonOfASearchThatIsNotOver) {
  messages::Health health;
  health.state = messages::MissionState::kSearch;
  health.steps_taken = 3;
  EXPECT_EQ(to_string(health), "SEARCH, after 3 steps");
  health.steps_taken = 1;
  EXPECT_EQ(to_string(health), "SEARCH, after 1 step");
}

// The core that brings a vehicle up after an outage knows of no step.
TEST(HealthWords, TellNoStepsOfWhatOnlyASafetyRecordKnows) {
  messages::Health health;
  health.state = messages::MissionState::kAbort;
  health.end_reason = messages::EndReason::kOutage;
  EXPECT_EQ(to_string(health), "ABORT, it could not go on after an outage");
}

TEST(HealthWords, TellTheStopOfThisProgramFromAnAbortThatCameBeforeIt) {
  messages::Health health;
  health.state = messages::MissionState::kAbort;
  health.end_reason = messages::EndReason::kOperatorAbort;
  health.steps_taken = 3;
  const std::string own = "ABORT, its program was stopped, after 3 steps";
  const std::string operators = "ABORT, an operator aborted it, after 3 steps";
  EXPECT_EQ(to_string(health, messages::MissionState::kStandby), own);
  EXPECT_EQ(to_string(health, messages::MissionState::kSearch), own);
  EXPECT_EQ(to_string(health, messages::MissionState::kDone), operators);
  EXPECT_EQ(to_string(health, messages::MissionState::kAbort), operators);
  health.end_reason = messages::EndReason::kNavigationStale;
  EXPECT_EQ(to_string(health, messages::MissionState::kSearch), "ABORT, navigation went silent, after 3 steps");
}

}  // namespace
}  // namespace earshot::board
