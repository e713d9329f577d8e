// GIVEN browsers that read, slowly or not at all, WHEN a flight goes on, THEN each has the newest of it, and none holds the others up.

#include <gtest/gtest.h>
#include <poll.h>

#include <memory>
#include <string>
#include <vector>

#include "policy/watch/http/audience.hpp"

namespace earshot::watch {
namespace {

Frame frame(const std::string& text) {
  return std::make_shared<const std::string>(text);
}

bool rings(const Browser& browser) {
  pollfd waits{browser.wake().file_descriptor(), POLLIN, 0};
  return ::poll(&waits, 1, 0) == 1;
}

TEST(Browser, IsGivenTheWholeFirstAndThenWhatComes) {
  Browser browser;
  EXPECT_TRUE(browser.asks());
  EXPECT_EQ(browser.push(frame("before")), 0U);
  EXPECT_EQ(browser.next(), nullptr);
  browser.give(frame("whole"));
  EXPECT_FALSE(browser.asks());
  EXPECT_EQ(browser.push(frame("news")), 0U);
  EXPECT_EQ(*browser.next(), "whole");
  EXPECT_EQ(*browser.next(), "news");
  EXPECT_EQ(browser.next(), nullptr);
}

TEST(Browser, WakesWhoSendsAsLongAsAFrameWaits) {
  Browser browser;
  EXPECT_FALSE(rings(browser));
  browser.give(frame("whole"));
  EXPECT_TRUE(rings(browser));
  (void)browser.next();
  (void)browser.next();
  EXPECT_FALSE(rings(browser));
}

TEST(Browser, ThatReadsTooSlowlyLosesWhatWaitsAndAsksForTheWholeOnceItReadsOn) {
  Browser browser;
  browser.give(frame("whole"));
  for (std::size_t i = 1; i < Browser::kMostFrames; ++i) EXPECT_EQ(browser.push(frame("news")), 0U);
  EXPECT_EQ(browser.push(frame("one too many")), Browser::kMostFrames + 1);
  EXPECT_FALSE(browser.asks()) << "it still does not read, and a whole flight would be made for nothing";
  EXPECT_EQ(browser.push(frame("later")), 1U);
  EXPECT_EQ(browser.next(), nullptr);
  EXPECT_TRUE(browser.asks());
  browser.give(frame("whole again"));
  EXPECT_EQ(*browser.next(), "whole again");
}

TEST(Browser, HoldsNoMoreBytesThanItMay) {
  Browser browser;
  browser.give(frame(std::string(Browser::kMostBytes - 10, 'x')));
  EXPECT_EQ(browser.push(frame("0123456789")), 0U);
  EXPECT_EQ(browser.push(frame("0")), 3U);
}

TEST(Browser, HoldsOneFrameHoweverLargeItIs) {
  Browser browser;
  browser.give(frame(std::string(2 * Browser::kMostBytes, 'x')));
  EXPECT_EQ(browser.next()->size(), 2 * Browser::kMostBytes);
  EXPECT_EQ(browser.push(frame("news")), 0U);
}

TEST(Audience, HasSoManyPlacesAndOneIsFreeWhenItsBrowserIsGone) {
  Audience audience;
  std::vector<std::shared_ptr<Browser>> browsers;
  for (std::size_t i = 0; i < Audience::kMostBrowsers; ++i) browsers.push_back(audience.join());
  EXPECT_NE(browsers.back(), nullptr);
  EXPECT_EQ(audience.join(), nullptr);
  browsers.pop_back();
  EXPECT_NE(audience.join(), nullptr);
}

TEST(Audience, GivesTheWholeToThoseThatAskAndCountsWhatTheOthersLost) {
  Audience audience;
  const auto stuck = audience.join();
  audience.give(frame("whole"));
  const auto late = audience.join();
  EXPECT_TRUE(audience.asks());
  EXPECT_TRUE(audience.has_followers());
  audience.give(frame("whole 2"));
  EXPECT_EQ(*stuck->next(), "whole");
  EXPECT_EQ(stuck->next(), nullptr);
  EXPECT_EQ(*late->next(), "whole 2");
  for (std::size_t i = 0; i < Browser::kMostFrames + 5; ++i) {
    audience.publish(frame("news"));
    EXPECT_EQ(*late->next(), "news");
  }
  EXPECT_EQ(audience.dropped_frames(), Browser::kMostFrames + 5);
}

TEST(Audience, AsksForTheFlightThatTakesThePlaceOfAnother) {
  Audience audience;
  const auto browser = audience.join();
  audience.give(frame("whole"));
  audience.restart();
  EXPECT_TRUE(browser->asks());
  EXPECT_EQ(browser->next(), nullptr);
}

}  // namespace
}  // namespace earshot::watch
