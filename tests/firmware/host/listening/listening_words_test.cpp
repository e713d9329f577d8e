#include "firmware/host/listening/listening_words.hpp"

#include <gtest/gtest.h>

#include <string>

namespace earshot::host {
namespace {

std::string complaint(const std::string& word, std::int64_t length_s) {
  try {
    (void)listening_window(word, length_s);
    return "";
  } catch (const BadInput& e) {
    return e.what();
  }
}

TEST(ListeningWords, MakeAWindowOfAWordAndALength) {
  EXPECT_EQ(listening_window("newest", 0), config::ListeningWindow{});
  EXPECT_EQ(listening_window("loudest", 30), (config::ListeningWindow{config::Listening::kLoudest, Duration::seconds(30)}));
  EXPECT_EQ(listening_window("mean", 1), (config::ListeningWindow{config::Listening::kMean, Duration::seconds(1)}));
  EXPECT_EQ(listening_window("mean", 120), (config::ListeningWindow{config::Listening::kMean, Duration::seconds(120)}));
}

TEST(ListeningWords, AreThoseThatAWindowIsReadFrom) {
  for (const char* word : {"loudest", "mean"}) {
    EXPECT_EQ(word_for(listening_window(word, 7).listening), word);
    EXPECT_EQ(length_s(listening_window(word, 7)), 7);
  }
  EXPECT_EQ(word_for(config::Listening::kNewest), "newest");
}

TEST(ListeningWords, RefuseAWindowThatCannotBeListenedOverAndSayWhichCan) {
  EXPECT_EQ(complaint("softest", 30), "\"softest\": must be \"newest\", \"loudest\" or \"mean\"");
  EXPECT_EQ(complaint("newest", 30), "\"newest\" goes without a window, not with one of 30 s");
  EXPECT_EQ(complaint("loudest", 0), "\"loudest\" needs a window of 1 to 120 s, not 0");
  EXPECT_EQ(complaint("mean", 121), "\"mean\" needs a window of 1 to 120 s, not 121");
  EXPECT_EQ(complaint("mean", -1), "\"mean\" needs a window of 1 to 120 s, not -1");
}

}  // namespace
}  // namespace earshot::host
