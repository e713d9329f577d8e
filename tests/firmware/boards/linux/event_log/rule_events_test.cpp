// event_log.cpp: what it tells of rules.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "firmware/config/safety.hpp"
#include "firmware/host/journal/words/rule_event_words.hpp"
#include "tests/firmware/boards/linux/event_log/logged_events.hpp"

namespace earshot::board {
namespace {

constexpr Time kMoment{1'795'000'000'000'000};  // 2026-11-18 11:06:40, as date(1) says

using RuleEvents = LoggedEvents;

TEST_F(RuleEvents, SaysOfARuleWhatTheJournalSays) {
  using config::Condition;
  std::string expected;
  std::uint8_t rule = 0;
  for (const Condition condition : {Condition::kNavigationDisputed, Condition::kPlaceUnexplained, Condition::kDepthUnexplained,
                                    Condition::kSetpointsUnsent, Condition::kDepth, Condition::kBattery, Condition::kLeak}) {
    const messages::SafetyEvent event{.time = kMoment,
                                      .rule = rule++,
                                      .condition = condition,
                                      .response = config::Response::kAbort,
                                      .begins = true,
                                      .measure = 275.25,
                                      .limit = condition == Condition::kSetpointsUnsent ? 10.0 : 0.0};
    event_log_->log(event);
    expected += "earshotd: 2026-11-18 11:06:40 UTC: " + journal::to_string(event) + "\n";
  }
  EXPECT_EQ(told(), expected);
}

}  // namespace
}  // namespace earshot::board
