#include "firmware/messages/dictionary/words.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/enumerators.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"

namespace earshot::messages {

namespace {
enum class Weather : std::uint8_t { kCalm, kBreeze, kGale };
enum class Late : std::uint8_t { kFirst = 1, kSecond = 2 };
enum class Holed : std::uint8_t { kNone = 0, kTwo = 2 };
}  // namespace

template <>
struct WordsOf<Weather> {
  static constexpr std::string_view kUnknown = "no weather";
  static constexpr auto kTable =
      std::to_array<Word<Weather>>({{Weather::kCalm, "calm", "calm", "it is calm"}, {Weather::kBreeze, "breeze", "breeze", "it blows"}});
};
template <>
struct WordsOf<Late> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kTable = std::to_array<Word<Late>>({{Late::kFirst, "a", "a", "a"}, {Late::kSecond, "b", "b", "b"}});
};
template <>
struct WordsOf<Holed> {
  static constexpr std::string_view kUnknown = "?";
  static constexpr auto kTable = std::to_array<Word<Holed>>({{Holed::kNone, "a", "a", "a"}, {Holed::kTwo, "b", "b", "b"}});
};

namespace {

TEST(DictionaryWords, LackWhereAnEnumHasAValueMoreThanItsTable) {
  static_assert(!has_all_words<Weather>(), "a gale has no words");
  static_assert(has_all_words<Late>(), "values may begin above 0");
  static_assert(!has_all_words<Holed>(), "a row's place says its value: there is no gap");
  static_assert(has_all_words<EndReason>());
}

TEST(DictionaryWords, CallAValueInFilesOnTheBusAndInSentences) {
  EXPECT_EQ(key_of(EndReason::kFound), "found");
  EXPECT_EQ(name_of(EndReason::kSnrStale), "SNR stale");
  EXPECT_STREQ(to_string(EndReason::kSnrStale), "the SNR estimate went silent");
  EXPECT_STREQ(to_string(MissionState::kSearch), "SEARCH");
  EXPECT_EQ(key_of(Order::kTighten), "tighten") << "of a table that begins at 1";
  EXPECT_STREQ(to_string(CommandOutcome::kTooOld), "refused: too old");
  EXPECT_EQ(key_of(config::Response::kSteerBack), "steer_back");
  EXPECT_EQ(name_of(config::Response::kSteerBack), "steer back");
  EXPECT_STREQ(to_string(config::Response::kSteerBack), "steer back into the fence");
  EXPECT_EQ(key_of(config::Condition::kSetpointsUnsent), "setpoints_unsent_s");
}

TEST(DictionaryWords, CallAMissionThatIsCompletedSoEverywhere) {
  EXPECT_EQ(key_of(EndReason::kCompleted), "completed");
  EXPECT_EQ(name_of(EndReason::kCompleted), "completed");
  EXPECT_STREQ(to_string(EndReason::kCompleted), "completed, the source is reached");
}

TEST(DictionaryWords, SayOfAnUnknownValueThatItIsOne) {
  EXPECT_STREQ(to_string(MissionState{200}), "?");
  EXPECT_STREQ(to_string(static_cast<EndReason>(static_cast<int>(kHighest<EndReason>) + 1)), "?");
  EXPECT_STREQ(to_string(Order{0}), "an unknown order");
  EXPECT_STREQ(to_string(static_cast<Order>(8)), "an unknown order");
  EXPECT_EQ(key_of(CommandOutcome{14}), "an unknown outcome");
  EXPECT_EQ(name_of(Weather::kGale), "no weather");
}

TEST(DictionaryWords, KnowWhichNumbersAreValues) {
  EXPECT_EQ(kLowest<Order>, Order::kStart);
  EXPECT_EQ(kHighest<Order>, Order::kTighten);
  EXPECT_TRUE(is_value_of<Order>(1));
  EXPECT_TRUE(is_value_of<Order>(7U));
  EXPECT_FALSE(is_value_of<Order>(0));
  EXPECT_FALSE(is_value_of<Order>(8));
  EXPECT_FALSE(is_value_of<EndReason>(std::int8_t{-1}));
  EXPECT_FALSE(is_value_of<EndReason>(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_TRUE(is_known(EndReason::kOutage));
  EXPECT_FALSE(is_known(static_cast<EndReason>(12)));
}

TEST(DictionaryWords, TellWhetherAnOrderWasObeyedThoughNoDiskHasIt) {
  EXPECT_TRUE(was_obeyed(CommandOutcome::kObeyed) && was_obeyed(CommandOutcome::kObeyedNotDurable));
  EXPECT_FALSE(was_obeyed(CommandOutcome::kRepeated));
}

}  // namespace
}  // namespace earshot::messages
