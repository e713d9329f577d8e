#include "policy/training/progress.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/text/tells.hpp"

namespace earshot::training {
namespace {

TEST(TrainingProgress, CountsNothingAsTakenThatWasTakenBeforeItBegan) {
  TrainingProgress progress(2, TrainingProgress::Voice::kSpeaks);
  progress.begin(0, {.fraction = 0.75, .steps = 3'000, .episodes = 60, .recent = {50, -2.0, 0.5}});
  progress.begin(1, {.fraction = 0.25, .steps = 1'000, .episodes = 20, .recent = {20, -4.0, 1.0}});
  EXPECT_TRUE(
      support::lines_tell(progress.line(), {{"50 %", "80 episodes", "4000 steps", "0", "steps/s", "50", "-3.0", "found 75 %", "0 s"}}));
}

TEST(TrainingProgress, SaysThatNoEpisodeHasEndedRatherThanThatItEarnedNothing) {
  TrainingProgress progress(1, TrainingProgress::Voice::kSpeaks);
  progress.begin(0, {.fraction = 1.0, .steps = 2, .episodes = 0, .recent = {}});
  EXPECT_NE(progress.line().find("median reward -, found - %"), std::string::npos) << progress.line();
}

TEST(TrainingProgress, PrintsNothingWhereThereIsNoTerminal) {
  testing::internal::CaptureStderr();
  TrainingProgress progress(1, TrainingProgress::Voice::kSpeaks);
  progress.update(0, {.fraction = 1.0, .steps = 1, .episodes = 1, .recent = {}});
  progress.finish();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace earshot::training
