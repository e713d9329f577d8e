// event_log.cpp: what it tells of orders that were not as they should be.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/firmware/boards/linux/event_log/logged_events.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

class OrderEvents : public LoggedEvents {
 protected:
  void turn(int at_s) { event_log_->log(Time{} + Duration::seconds(at_s), messages::Health{}); }
};

TEST_F(OrderEvents, TellsOfUnreadableOrdersOnceInTenSecondsWithTheirNumberAndTheRemedy) {
  turn(0);
  event_log_->log(1, OrderTrouble::kUnreadable);
  turn(1);
  for (int second = 2; second < 11; ++second) {
    for (int i = 0; i < 5; ++i) event_log_->log(1, OrderTrouble::kUnreadable);
    turn(second);
  }
  turn(11);
  turn(12);
  const std::string text = told();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 2) << text;  // STANDBY, and two of orders
  EXPECT_TRUE(support::has_line(text, {"order", "not", "read", "not obeyed"})) << text;
  EXPECT_NE(text.find("mark = bytes(16)"), std::string::npos) << text;
  EXPECT_NE(text.find("; 45 such since it was last reported\n"), std::string::npos) << text;
}

TEST_F(OrderEvents, TellsEachTroubleOfEachPortApart) {
  event_log_->log(1, OrderTrouble::kCutAbort);
  event_log_->log(1, OrderTrouble::kOldMark);
  event_log_->log(2, OrderTrouble::kCutAbort);
  turn(0);
  const std::string text = told();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 3) << text;
  EXPECT_TRUE(support::has_line(text, {"ABORT", "obeyed whose", "not"})) << text;
}

TEST_F(OrderEvents, HasRoomForTheWordsOfEveryTrouble) {
  for (std::size_t i = 0; i < kOrderTroubleCount; ++i) {
    const std::string_view words = to_string(static_cast<OrderTrouble>(i));
    EXPECT_FALSE(words.empty()) << i;
    // A date, a port's name and the count take 150 characters.
    EXPECT_LT(words.size() + 150, LineWriter::kLineBytes) << words;
  }
}

}  // namespace
}  // namespace earshot::board
