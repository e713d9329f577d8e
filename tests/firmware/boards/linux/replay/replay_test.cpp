#include "firmware/boards/linux/replay/replay.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "earshot/controller_trouble_t.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/replay/random_mission.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::board {
namespace {

namespace fs = std::filesystem;

class Replay : public testing::Test {
 protected:
  /// Writes the journal again, with one bit of a record's message (behind fingerprint and date) another and every checksum right.
  static void flip_bit(const fs::path& from, std::uint32_t number, const fs::path& to) {
    host::Journal journal(to, {.existing = host::ExistingJournal::kReplace});
    host::JournalReader reader(from);
    for (host::JournalRecord record; reader.next(record);) {
      if (record.number == number) record.data[16] ^= 1U;
      ASSERT_EQ(journal.append(record.time, record.channel, record.data), Status::kOk);
    }
  }

  /// A search that only listens decides anew after the 500 s in which it would have sailed 1000 m at 2 m/s.
  void listen_for_two_steps() const {
    std::vector<Happening> script;
    for (int second = 1; second <= 600; ++second) {
      const Time now = Time{1'795'000'000'000'000} + Duration::seconds(second);
      script.push_back(
          {.time = now,
           .port = 1,
           .input = messages::Navigation{
               .time = now, .position = at(12'000, 12'000), .depth = Meters{300}, .heading = Radians{0}, .speed = MetersPerSecond{0}}});
      script.push_back({.time = now, .port = 1, .input = messages::SnrMeasurement{.time = now, .snr = Decibels{12}}});
      if (second == 2) script.push_back({.time = now, .port = 1, .input = runtime::command_of(messages::Order::kListen, now)});
      script.push_back({.time = now});
    }
    Vessel vessel(walking_mission(1), path_);
    vessel.live_through(script);
    vessel.end();
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal";
};

TEST_F(Replay, GivesEveryByteOfTenThousandJournalsOfRandomInputsAgain) {
  std::size_t decisions = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    fly_random_mission(seed, path_, 30);
    const ReplayResult result = replay(path_);
    ASSERT_TRUE(result.is_same()) << "seed " << seed << ", record " << (result.difference ? result.difference->record : *result.gap);
    ASSERT_EQ(result.turns, 30U) << "seed " << seed;
    decisions += result.decisions;
  }
  EXPECT_GT(decisions, 1000U) << "most missions never began to search";
}

TEST_F(Replay, GivesASearchAgainThatEndsBecauseNoSetpointLeaves) {
  std::vector<Happening> script;
  for (int second = 1; second <= 20; ++second) {
    const Time now = Time{1'795'000'000'000'000} + Duration::seconds(second);
    const auto happens = [&](const InputSink::Value& value) { script.push_back({.time = now, .port = 1, .input = value}); };
    happens(messages::Navigation{
        .time = now, .position = at(12'000 + second, 12'000), .depth = Meters{300}, .heading = Radians{0}, .speed = MetersPerSecond{1.25}});
    happens(messages::SnrMeasurement{.time = now, .snr = Decibels{12}});
    if (second == 2) happens(runtime::command_of(messages::Order::kStart, now));
    script.push_back({.time = now});
  }
  Vessel vessel(walking_mission(1), path_);
  vessel.mute();
  vessel.live_through(script);
  EXPECT_EQ(vessel.standing().end_reason, messages::EndReason::kSafetyRule);
  vessel.end();
  EXPECT_TRUE(replay(path_).is_same());
}

TEST_F(Replay, PassesOverWhatIsSaidOfACanControllerBetweenTwoTurnsAndNowhereElse) {
  fly_random_mission(1, path_, 30);
  const fs::path remarked = path_.string() + "-remarked";
  const auto remark_behind = [&](std::string_view channel) {
    host::Journal journal(remarked, {.existing = host::ExistingJournal::kReplace});
    host::JournalReader reader(path_);
    const controller_trouble_t trouble{.utime = 0, .port = 1, .trouble = controller_trouble_t::BUS_OFF, .is_there = 1};
    for (host::JournalRecord record; reader.next(record);) {
      EXPECT_EQ(journal.append(record.time, record.channel, record.data), Status::kOk);
      if (record.channel != channel) continue;
      EXPECT_EQ(journal.append(record.time, wire::kControllerTroubleChannel, support::bytes_of(trouble)), Status::kOk);
    }
  };
  remark_behind(wire::kHealthChannel);  // the last record of a turn
  const ReplayResult result = replay(remarked);
  EXPECT_TRUE(result.is_same());
  EXPECT_EQ(result.turns, 30U);
  remark_behind(wire::kJournalledSetpointChannel);
  EXPECT_FALSE(replay(remarked).is_same());
}

TEST_F(Replay, FindsTheOutputInWhichOneBitDiffers) {
  fly_random_mission(1, path_, 30);
  // The last record is a health record: its byte of the mission's state follows header (28), channel (14), fingerprint (8) and date (8).
  host::JournalReader reader(path_);
  std::size_t last = 0;
  std::uint32_t number = 0;
  for (host::JournalRecord record;;) {
    const std::size_t begins = reader.offset();
    if (!reader.next(record)) break;
    last = begins;
    number = record.number;
  }
  const fs::path forged = path_.string() + "-forged";
  host::Journal journal(forged, {.existing = host::ExistingJournal::kReplace});
  host::JournalReader again(path_);
  for (host::JournalRecord record; again.next(record);) {
    if (record.number == number) record.data[16] ^= 1U;
    ASSERT_EQ(journal.append(record.time, record.channel, record.data), Status::kOk);
  }
  ASSERT_EQ(journal.close(), Status::kOk);
  const ReplayResult result = replay(forged);
  fs::remove(forged);
  ASSERT_TRUE(result.difference) << last;
  EXPECT_EQ(result.difference->record, number);
  EXPECT_EQ(result.difference->channel, "EARSHOT_HEALTH");
}

TEST_F(Replay, FromALaterStepOnPassesOverADifferenceBeforeItAndFindsOneBehindIt) {
  listen_for_two_steps();
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  host::JournalReader reader(path_);
  for (host::JournalRecord record; reader.next(record);) {
    if (record.channel != "EARSHOT_HEALTH") continue;
    if (first == 0) first = record.number;
    last = record.number;
  }
  const fs::path forged = folder_ / "forged";
  flip_bit(path_, first, forged);
  const ReplayResult whole = replay(forged);
  ASSERT_TRUE(whole.difference);
  EXPECT_EQ(whole.difference->record, first);
  const ReplayResult later = replay(forged, {.from_step = 1});
  EXPECT_TRUE(later.is_same());
  EXPECT_TRUE(later.was_compared);
  EXPECT_EQ(later.decisions, 2U);
  EXPECT_FALSE(replay(forged, {.from_step = 1000}).was_compared);
  flip_bit(path_, last, forged);
  const ReplayResult behind = replay(forged, {.from_step = 1});
  ASSERT_TRUE(behind.difference);
  EXPECT_EQ(behind.difference->record, last);
  EXPECT_EQ(behind.difference->now->channel, "EARSHOT_HEALTH");
}

TEST_F(Replay, TellsAJournalThatWasEndedInOrderFromOneWhoseEndIsMissing) {
  Vessel vessel(walking_mission(1), path_);
  vessel.live_through(RandomScript(1).turns(30));
  const messages::ClosingRecord said = vessel.standing();
  vessel.end(said);
  const ReplayResult whole = replay(path_);
  EXPECT_TRUE(whole.is_same());
  EXPECT_EQ(whole.closing, said);
  fs::resize_file(path_, fs::file_size(path_) - 94);  // 28 + 19 + 47: as if it had been killed
  const ReplayResult killed = replay(path_);
  EXPECT_TRUE(killed.is_same());
  EXPECT_EQ(killed.end, host::JournalReader::End::kWhole);
  EXPECT_EQ(killed.turns, whole.turns);
  EXPECT_FALSE(killed.closing);
}

TEST_F(Replay, FindsAnOutputThatIsDatedAnInstantBehindItsTurn) {
  fly_random_mission(1, path_, 30);
  const fs::path forged = folder_ / "forged";
  std::uint32_t number = 0;
  Time turn;
  {
    host::Journal journal(forged);
    host::JournalReader reader(path_);
    for (host::JournalRecord record; reader.next(record);) {
      if (record.channel == "EARSHOT_HEALTH" && number == 0) {
        number = record.number;
        turn = record.time;
        record.time = record.time + Duration{1};
      }
      ASSERT_EQ(journal.append(record.time, record.channel, record.data), Status::kOk);
    }
  }
  const ReplayResult result = replay(forged);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->record, number);
  ASSERT_TRUE(result.difference->now);
  EXPECT_EQ(result.difference->now->time, turn);
}

TEST_F(Replay, FindsAClosingRecordThatTellsOfAnotherEnd) {
  Vessel vessel(walking_mission(1), path_);
  vessel.live_through(RandomScript(1).turns(30));
  messages::ClosingRecord said = vessel.standing();
  ++said.steps_taken;
  vessel.end(said);
  const ReplayResult result = replay(path_);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->channel, "EARSHOT_JOURNAL_END");
  EXPECT_EQ(result.closing, said);
}

TEST_F(Replay, FindsRecordsThatAreMissingAtTheEndByTheNumberOfTheClosingRecord) {
  fly_random_mission(1, path_, 30, messages::ClosingRecord{});
  std::vector<std::uint64_t> begins;
  host::JournalReader reader(path_);
  for (host::JournalRecord record;;) {
    begins.push_back(reader.offset());
    if (!reader.next(record)) break;
  }
  const std::uint64_t closing = begins[begins.size() - 2];
  const std::uint64_t last_turn = begins[begins.size() - 3];
  std::ifstream file(path_, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(last_turn), bytes.begin() + static_cast<std::ptrdiff_t>(closing));
  support::write_bytes(path_, bytes);
  const ReplayResult result = replay(path_);
  EXPECT_EQ(result.gap, begins.size() - 3);
  EXPECT_TRUE(result.closing);
}

TEST_F(Replay, TellsOfBytesAndOfAnotherFlightBehindTheRecordThatEndsTheJournal) {
  Vessel vessel(walking_mission(1), path_);
  vessel.live_through(RandomScript(1).turns(30));
  const messages::ClosingRecord said = vessel.standing();
  vessel.end(said);
  std::ifstream file(path_, std::ios::binary);
  const std::vector<std::uint8_t> alone{std::istreambuf_iterator<char>(file), {}};
  std::size_t records = 0;
  host::JournalReader reader(path_);
  for (host::JournalRecord record; reader.next(record);) ++records;
  std::vector<std::uint8_t> twice = alone;
  twice.insert(twice.end(), alone.begin(), alone.end());
  twice[twice.size() - 1] ^= 1U;  // in the last record of the second, which is none then: 28 + 19 + 47 bytes
  support::write_bytes(path_, twice);
  const ReplayResult result = replay(path_);
  EXPECT_TRUE(result.is_same());
  ASSERT_TRUE(result.closing);
  EXPECT_EQ(*result.closing, said);
  EXPECT_EQ(result.records_behind_end, records - 1);
  EXPECT_EQ(result.end, host::JournalReader::End::kCorrupt);
  ASSERT_EQ(result.damages.size(), 1U);
  EXPECT_EQ(result.damages[0].offset, twice.size() - 94);
  EXPECT_EQ(result.damages[0].bytes, 94U);
}

TEST_F(Replay, RefusesATurnThatIsDatedBeforeAllClocksOrBehindThem) {
  fly_random_mission(1, path_, 30);
  for (const std::int64_t date_us : {std::int64_t{-1}, (std::int64_t{1} << 55U) + 1, std::numeric_limits<std::int64_t>::max()}) {
    const fs::path forged = folder_ / "forged";
    {
      host::Journal journal(forged, {.existing = host::ExistingJournal::kReplace});
      host::JournalReader reader(path_);
      for (host::JournalRecord record; reader.next(record);) {
        const Time time = record.channel == "EARSHOT_HEALTH" ? Time{date_us} : record.time;
        ASSERT_EQ(journal.append(time, record.channel, record.data), Status::kOk);
      }
    }
    EXPECT_THROW((void)replay(forged), host::BadInput) << date_us;
  }
}

TEST_F(Replay, RefusesAJournalThatDoesNotBeginWithItsMission) {
  {
    host::Journal journal(path_, {.existing = host::ExistingJournal::kReplace});
    ASSERT_EQ(journal.append(Time{1}, "EARSHOT_HEALTH", std::array<std::uint8_t, 3>{1, 2, 3}), Status::kOk);
  }
  EXPECT_THROW((void)replay(path_), host::BadInput);
}

}  // namespace
}  // namespace earshot::board
