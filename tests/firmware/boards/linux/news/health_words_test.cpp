#include "firmware/boards/linux/news/health_words.hpp"

#include <gtest/gtest.h>

namespace earshot::board {
namespace {

TEST(HealthWords, TellStateReasonAndSteps) {
  messages::Health health;
  health.state = messages::MissionState::kDone;
  health.end_reason = messages::EndReason::kCompleted;
  health.steps_taken = 37;
  EXPECT_EQ(to_string(health), "DONE, the source is reached, after 37 steps");
}

TEST(HealthWords, TellNoReasonOfASearchThatIsNotOver) {
  messages::Health health;
  health.state = messages::MissionState::kSearch;
  health.steps_taken = 3;
  EXPECT_EQ(to_string(health), "SEARCH, after 3 steps");
}

}  // namespace
}  // namespace earshot::board
