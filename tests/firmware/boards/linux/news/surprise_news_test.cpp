// flight_news.cpp: what it tells of a search that does not believe what it hears.

#include <gtest/gtest.h>

#include <string>

#include "firmware/messages/dictionary/health_words.hpp"
#include "tests/firmware/boards/linux/news/told_news.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

/// A search of which each turn is told, 20 s after the one before.
class SurpriseNews : public ToldNews {
 protected:
  void tell(float surprise_bits, bool is_sweeping) {
    messages::Health health;
    health.state = messages::MissionState::kSearch;
    health.surprise_bits = surprise_bits;
    health.is_sweeping = is_sweeping;
    news_->tell(now_, health);
    now_ = now_ + Duration::seconds(20);
  }

 private:
  Time now_;
};

TEST_F(SurpriseNews, SaysOnceThatASearchIsSurprisedAndThatItSweeps) {
  tell(6.7F, false);
  tell(6.75F, false);
  tell(5.0F, false);
  tell(12.0F, true);
  EXPECT_TRUE(support::lines_tell(told(), {{"earshotd", "0 s", "SEARCH"},
                                           {"earshotd", "20 s", "SEARCH", messages::kIsSurprised},
                                           {"earshotd", "60 s", "SEARCH", messages::kSweeps}}));
}

TEST_F(SurpriseNews, SaysThatASearchSweepsBecauseItHasHeardNothingAndWhenThatIsOver) {
  tell(-9.0F, false);
  tell(-9.5F, true);
  tell(-9.5F, true);
  tell(-9.0F, false);
  EXPECT_TRUE(support::lines_tell(
      told(), {{"earshotd", "0 s", "SEARCH"}, {"earshotd", "20 s", "SEARCH", messages::kSweepsInSilence}, {"earshotd", "60 s", "SEARCH"}}));
}

}  // namespace
}  // namespace earshot::board
