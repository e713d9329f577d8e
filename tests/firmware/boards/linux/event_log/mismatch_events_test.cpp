// event_log.cpp: what it tells of a search that does not believe what it hears.

#include <gtest/gtest.h>

#include <string>

#include "firmware/messages/dictionary/health_words.hpp"
#include "tests/firmware/boards/linux/event_log/logged_events.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

/// A search of which each turn is told, 20 s after the one before.
class MismatchEvents : public LoggedEvents {
 protected:
  void take_health(float mismatch_bits, bool is_sweeping) {
    messages::Health health;
    health.state = messages::MissionState::kSearch;
    health.mismatch_bits = mismatch_bits;
    health.is_sweeping = is_sweeping;
    event_log_->log(now_, health);
    now_ = now_ + Duration::seconds(20);
  }

 private:
  Time now_;
};

TEST_F(MismatchEvents, SaysOnceThatASearchHasAMismatchAndThatItSweeps) {
  take_health(6.7F, false);
  take_health(6.75F, false);
  take_health(5.0F, false);
  take_health(12.0F, true);
  EXPECT_TRUE(support::lines_tell(told(), {{"earshotd", "0 s", "SEARCH"},
                                           {"earshotd", "20 s", "SEARCH", messages::kIsMismatched},
                                           {"earshotd", "60 s", "SEARCH", messages::kSweeps}}));
}

TEST_F(MismatchEvents, SaysThatASearchSweepsBecauseItHasHeardNothingAndWhenThatIsOver) {
  take_health(-9.0F, false);
  take_health(-9.5F, true);
  take_health(-9.5F, true);
  take_health(-9.0F, false);
  EXPECT_TRUE(support::lines_tell(
      told(), {{"earshotd", "0 s", "SEARCH"}, {"earshotd", "20 s", "SEARCH", messages::kSweepsInSilence}, {"earshotd", "60 s", "SEARCH"}}));
}

}  // namespace
}  // namespace earshot::board
