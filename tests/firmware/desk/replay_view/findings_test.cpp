#include "firmware/desk/replay_view/findings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::replay_view {
namespace {

using Lines = std::vector<std::string>;

constexpr Time kBegan{1'795'000'000'000'000};

board::ReplayResult whole() {
  board::ReplayResult result;
  result.inputs = 30;
  result.turns = 10;
  result.decisions = 1;
  result.was_compared = true;
  result.began = kBegan;
  result.ended = kBegan + Duration::seconds(10);
  result.closing = messages::ClosingRecord{};
  return result;
}

TEST(Findings, OfAWholeJournalThatIsTheSameAreNone) {
  EXPECT_EQ(findings(whole()), Lines{});
  EXPECT_EQ(figures(whole(), 0.02), "30 inputs, 10 turns and 1 decision; 10.0 s of mission in 0.02 s, 500 times real time");
  EXPECT_EQ(praise(whole(), 0), "every output is the same, byte for byte");
  EXPECT_EQ(praise(whole(), 4), "every output from step 4 on is the same, byte for byte");
}

TEST(Findings, NameTheFirstDifferenceByRecordTimeChannelAndField) {
  messages::Health health;
  health.turn = 7;
  const wire::Encoded then(health, kBegan);
  health.turn = 8;
  const wire::Encoded now(health, kBegan);
  board::ReplayResult result = whole();
  result.difference = {
      .record = 57,
      .channel = "EARSHOT_HEALTH",
      .time = kBegan + Duration::milliseconds(1500),
      .data = {then.bytes().begin(), then.bytes().end()},
      .now = board::Playback::Unwritten{wire::kHealthChannel, now, host::Priority::kStream, kBegan + Duration::milliseconds(1500)}};
  EXPECT_EQ(findings(result),
            Lines{"record 57, EARSHOT_HEALTH at 1.500 s: turn is 7 in the journal, 8 now; what follows was not given again"});
  result.difference->now->channel = wire::kDecisionChannel;
  EXPECT_EQ(to_string(*result.difference, kBegan), "record 57, EARSHOT_HEALTH at 1.500 s: the runtime gives EARSHOT_DECISION there now");
  result.difference->now.reset();
  EXPECT_EQ(to_string(*result.difference, kBegan),
            "record 57, EARSHOT_HEALTH at 1.500 s: no output has its place there, and it is no input that can be read");
}

TEST(Findings, NameTheDateOfARecordThatIsNotThatOfItsTurn) {
  const wire::Encoded health(messages::Health{}, kBegan);
  board::ReplayResult result = whole();
  result.difference = {.record = 57,
                       .channel = "EARSHOT_HEALTH",
                       .time = kBegan + Duration::milliseconds(1500),
                       .data = {health.bytes().begin(), health.bytes().end()},
                       .now = board::Playback::Unwritten{wire::kHealthChannel, health, host::Priority::kStream, kBegan}};
  EXPECT_EQ(to_string(*result.difference, kBegan),
            "record 57, EARSHOT_HEALTH at 1.500 s: time_s is 1795000001.500000 in the journal, 1795000000.000000 now");
}

TEST(Findings, NameWhatIsMissingAndDamaged) {
  board::ReplayResult result = whole();
  result.gap = 9;
  result.closing.reset();
  result.damages = {{.offset = 100, .bytes = 3}};
  EXPECT_EQ(findings(result), (Lines{"record 9 is missing; what follows was not given again",
                                     "damaged: 3 bytes from byte 100 on are no record, or do not match their checksum",
                                     "the journal's end is missing: its program was killed, lost its power, or writes it still"}));
  result.end = host::JournalReader::End::kCut;
  EXPECT_EQ(findings(result)[1],
            "the journal ends in the middle of a record (3 bytes from byte 100 on): its program was stopped while it wrote");
  result.end = host::JournalReader::End::kCorrupt;
  EXPECT_EQ(findings(result)[1], "the end is damaged: 3 bytes from byte 100 on are no record");
  EXPECT_EQ(praise(result, 0), "every output up to there is the same, byte for byte");
}

TEST(Findings, NameWhatStandsBehindTheEnd) {
  board::ReplayResult result = whole();
  result.records_behind_end = 1;
  EXPECT_EQ(findings(result), Lines{"behind the record that ends the journal: 1 record of something else, not given again"});
  EXPECT_EQ(praise(result, 0), "every output up to there is the same, byte for byte");
}

}  // namespace
}  // namespace earshot::replay_view
