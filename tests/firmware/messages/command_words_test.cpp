#include "firmware/messages/command_words.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace earshot::messages {
namespace {

TEST(CommandWords, TellEveryOrderApartAndAnUnknownOneFromAll) {
  std::set<std::string> words;
  const int last = static_cast<int>(kLastOrder);
  for (int order = 1; order <= last; ++order) words.insert(to_string(static_cast<Order>(order)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(last));
  EXPECT_FALSE(words.contains("an unknown order"));
  EXPECT_STREQ(to_string(static_cast<Order>(last + 1)), "an unknown order");
  EXPECT_STREQ(to_string(Order::kTighten), "TIGHTEN");
}

TEST(CommandWords, TellEveryOutcomeApart) {
  std::set<std::string> words;
  const int last = static_cast<int>(kLastCommandOutcome);
  for (int outcome = 0; outcome <= last; ++outcome) words.insert(to_string(static_cast<CommandOutcome>(outcome)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(last) + 1);
  EXPECT_FALSE(words.contains("refused"));
  EXPECT_STREQ(to_string(CommandOutcome::kObeyed), "obeyed");
  EXPECT_STREQ(to_string(CommandOutcome::kTooOld), "refused: too old");
  EXPECT_TRUE(was_obeyed(CommandOutcome::kObeyed) && was_obeyed(CommandOutcome::kObeyedNotDurable));
  EXPECT_FALSE(was_obeyed(CommandOutcome::kRepeated));
}

}  // namespace
}  // namespace earshot::messages
