#include "firmware/host/journal/words/event_words.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::journal {
namespace {

using messages::EndReason;
using messages::MissionState;

std::string standing(MissionState state, EndReason reason, std::uint32_t steps, AbortedBy by = AbortedBy::kOperator) {
  host::TextLine line;
  write_standing(line, state, reason, steps, by);
  return std::string(line.text());
}

TEST(EventWords, GiveAStateItsReasonAndItsSteps) {
  EXPECT_EQ(standing(MissionState::kAbort, EndReason::kNavigationStale, 12), "ABORT, navigation went silent, after 12 steps");
  EXPECT_EQ(standing(MissionState::kSearch, EndReason::kNone, 1), "SEARCH, after 1 step");
  EXPECT_EQ(standing(MissionState::kAbort, EndReason::kOutage, 0), "ABORT, it could not go on after an outage") << "of which none is known";
}

TEST(EventWords, KnowAnOperatorsAbortFromThatOfAProgramThatIsStopped) {
  EXPECT_EQ(standing(MissionState::kAbort, EndReason::kOperatorAbort, 3), "ABORT, an operator aborted it, after 3 steps");
  EXPECT_EQ(standing(MissionState::kAbort, EndReason::kOperatorAbort, 3, AbortedBy::kProgram),
            "ABORT, its program was stopped, after 3 steps");
  EXPECT_EQ(standing(MissionState::kAbort, EndReason::kSnrStale, 3, AbortedBy::kProgram),
            "ABORT, the SNR estimate went silent, after 3 steps");
}

TEST(EventWords, GiveARemarkOnlyOfAMissionThatIsNotOver) {
  messages::Health health;
  health.state = MissionState::kSearch;
  health.steps_taken = 3;
  const auto state = [&health] {
    host::TextLine line;
    write_state(line, health, "paused by an operator", AbortedBy::kOperator);
    return std::string(line.text());
  };
  EXPECT_EQ(state(), "SEARCH, paused by an operator");
  health.state = MissionState::kDone;
  health.end_reason = EndReason::kStepsUsedUp;
  EXPECT_EQ(state(), "DONE, all steps are taken, after 3 steps");
}

TEST(EventWords, CountMessagesThatWereNotTaken) {
  host::TextLine refused;
  write_refused(refused, "SNR", 1);
  EXPECT_EQ(refused.text(), "SNR: 1 message refused so far, for their date, their order or what is in them");
  host::TextLine others;
  write_bearings_of_others(others, 7);
  EXPECT_EQ(others.text(), "bearing: 7 messages of a second sender not taken so far");
}

}  // namespace
}  // namespace earshot::journal
